// The only place where a device, its transports, the clock and the renderer meet: one reader per port, one
// outbox with one writer. It understands no message.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/clock/asio.h"
#include "emulator/clock/clock.h"
#include "emulator/contract/device.h"
#include "emulator/contract/ping_log.h"
#include "emulator/contract/transmission.h"
#include "emulator/run/device_threads.h"
#include "emulator/run/lateness.h"
#include "emulator/run/outbox.h"
#include "emulator/run/overload.h"
#include "emulator/run/session_summary.h"
#include "emulator/transport/transport.h"
#include "emulator/truth/remark.h"
#include "emulator/water/crosstalk.h"
#include "emulator/water/rendering.h"
#include "emulator/water/second_time_around.h"
#include "render/scene/scene.h"

namespace echoloop {

class Dataset;
class DeviceTruth;
struct PingTruth;
class Watch;

/// What the sessions of a run share: the water that they all ping in.
struct SharedWater {
    Water water;
    Effects effects;         ///< none where the renderer's rule knows none
    std::uint64_t seed = 0;  ///< of the scenario
    Bounds scene;
    CrossTalk cross_talk;
    std::size_t sonars = 0;  ///< sessions so far
    /// nullptr: devices make their bytes in turn, for runs whose every event has its place. Join them before
    /// the sessions end.
    std::unique_ptr<DeviceThreads> device_threads{};
    std::vector<double> reach{};  ///< m, from each mover's origin to its farthest point
};

class Session {
  public:
    /// Where the sonar and everything that moves is at a time of the run.
    using SituationAt = std::function<Situation(Time)>;
    /// Where the sonar alone is.
    using LocatedAt = std::function<Located(Time)>;

    /// `transports`: one per port of the device, in the order of ports().
    Session(asio::io_context& io, Clock& clock, RenderThreads& renderers, SharedWater& water,
            std::string name, std::unique_ptr<Device> device,
            std::vector<std::unique_ptr<Transport>> transports, SituationAt situation_at,
            LocatedAt located_at);
    ~Session();

    /// Before start(). `truth` gets every ping from then on.
    void tell(std::unique_ptr<DeviceTruth> truth);
    /// Before start(), after tell(): `dataset` gets every ping, and what is said for it, as `sonar`'s.
    void keep_in(Dataset& dataset, std::size_t sonar) { dataset_ = &dataset, number_in_it_ = sonar; }
    /// Before start(): who is told which ping is heard and sent. It outlives this.
    void tell_of_pings(PingLog& log) { log_ = &log; }

    /// Where the vehicle is, and how it moves in the world.
    using BodyAt = std::function<std::pair<Pose, Motion>(Time)>;
    /// Before start(): who looks on. It outlives this.
    void be_watched(Watch& watch, BodyAt body) { watch_ = &watch, body_at_ = std::move(body); }

    /// Before start(): the first packet of each ping gets a comment that says where the sonar was.
    void sends_no_pings() { summary_.is_sonar = false; }
    void remark_pings(std::function<Surroundings(Vec3)> around) { around_ = std::move(around); }

    void start();
    /// `before` is called on this thread before the device hears an echogram, and `after` with what
    /// that made it do, wherever it heard it.
    void around_hearing(std::function<void(Time)> before, std::function<Actions(Actions, Time)> after) {
        before_hearing_ = std::move(before);
        after_hearing_ = std::move(after);
    }
    /// The device has lost its power: what it was about to send, and its pings, are gone. `cut` is called
    /// when no thread is with the device.
    void cut_power(std::function<void()> cut);
    /// Powers the device up again.
    void power_up() {
        to_device([this] { apply_now(device_->started(clock_.now())); });
    }
    void close();
    const std::vector<std::unique_ptr<Transport>>& transports() const { return transports_; }
    SessionSummary summary() const;

  private:
    /// What the device did at `time`.
    void apply(Actions actions, Time time);
    void apply_now(Actions actions) { apply(std::move(actions), clock_.now()); }
    void transmit(Ping ping, Time time);
    void locate(const std::vector<Time>& times, Time now);
    std::shared_ptr<Rendering> render(Time needed, Shot shot, Situation situation);
    /// A ping on its way, and its place in the row of this session's pings.
    struct UnderWay {
        Transmission transmission;
        std::uint64_t sequence;
        Time due;
        std::shared_ptr<Rendering> echoes, late_before;  ///< late_before: of the ping before, may be nullptr
        Situation situation;
        double unix_time;       ///< s since 1970, of the transmission
        std::uint64_t powered;  ///< power_cuts_ when it was sent
        bool watched;
        std::pair<Pose, Motion> body;  ///< of the vehicle at the transmission, where it is watched
        Time woken{};                  ///< when it was seen to be due
        Time overslept{};              ///< by then
        Time waited{};                 ///< from then on, for its rendering
    };
    Task<void> deliver(UnderWay ping);
    void hear(UnderWay& ping);
    void count_late(const UnderWay& ping, Time now);
    /// What a watch is told beside the echogram.
    struct Seen {
        Time transmitted, late, drawn, due;
        std::vector<std::uint16_t> objects;
        std::vector<Pose> movers;
        double unix_time;
        std::pair<Pose, Motion> body;
        Motion sonar;
        std::vector<std::string> faults;
    };
    /// What the device is about to hear; nothing else touches its late echoes meanwhile.
    struct Heard {
        Echogram echogram;
        std::optional<Echogram> late_before;
        std::vector<ForeignPulse> foreign;
        std::uint64_t sequence;
        Time now;
        std::optional<Seen> seen{};
        std::shared_ptr<PingTruth> kept{};  ///< for the data set; nullptr: there is none
    };
    Actions hear_all(Heard& heard);
    /// On another thread, which this session outlives.
    void hear_elsewhere(std::shared_ptr<Heard> heard);
    /// Lets `event` happen to the device now, or once it has heard the echogram that it is busy with.
    void to_device(std::function<void()> event) { hearing_ ? waiting_.push_back(std::move(event)) : event(); }
    /// The same with what it did; nothing if it has lost its power meanwhile.
    void act(std::function<Actions()> event);
    Task<void> keep_waking();
    Task<void> keep_writing();
    void post_mail(Send send);
    /// In the outbox; nullptr: it is dropped.
    const Mail* keep(Send send);

    asio::io_context& io_;
    Clock& clock_;
    SharedWater& water_;
    std::size_t sonar_;  ///< number of this session
    std::string name_;
    std::unique_ptr<Device> device_;
    std::vector<std::unique_ptr<Transport>> transports_;
    SituationAt situation_at_;
    LocatedAt located_at_;
    RenderThreads& renderers_;
    std::unique_ptr<DeviceTruth> truth_;  ///< nullptr: nobody asks
    Dataset* dataset_ = nullptr;          ///< the same
    std::size_t number_in_it_ = 0;

    Outbox outbox_;
    Lateness lateness_;
    Overload overload_;
    /// What a remark on a ping says of its place; none: there are no remarks.
    std::function<Surroundings(Vec3)> around_;
    std::string remark_;  ///< of the ping that was heard last, until a message takes it along
    Alarm mail_;          ///< rings when the outbox has a new first element
    Alarm alarm_;         ///< rings at wake_
    Time wake_ = Time::max();
    Time acted_{};             ///< when the device did something last
    bool hearing_ = false;     ///< the device belongs to another thread
    DeviceCounters counters_;  ///< meanwhile: what they were before
    std::function<void(Time)> before_hearing_ = [](Time) {};
    std::function<Actions(Actions, Time)> after_hearing_ = [](Actions actions, Time) { return actions; };
    std::deque<std::function<void()>> waiting_;
    PingLog* log_ = nullptr;  ///< nullptr: nobody asks
    Watch* watch_ = nullptr;  ///< nullptr: nobody looks
    BodyAt body_at_;          ///< for it
    std::uint64_t power_cuts_ = 0;
    std::uint64_t heard_ = 0;  ///< number of the ping heard last, from 1

    SecondTimeAround late_echoes_;
    std::shared_ptr<Rendering> late_;  ///< of the last ping, may be nullptr
    std::uint64_t sequence_ = 0;       ///< of the last ping
    Time silent_from_ = Time::max();   ///< when the echoes of the last ping have died away
    SessionSummary summary_;
};

}  // namespace echoloop
