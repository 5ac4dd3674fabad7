// What a run shows to those who look: the last pings of each sonar and the
// messages on its wires. It keeps little, and nothing while nobody looks. Knows
// no sockets.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "emulator/capture/watch.h"
#include "tools/view/picture.h"

namespace echoloop::view {

/// Bytes of one direction of a port, as they passed.
struct Passed {
    std::string device, port;
    bool sent = false, packets = false;
    double unix_time = 0;  ///< s since 1970
    Bytes bytes;           ///< the first of them, where there are very many
    std::size_t size = 0;
    bool gap = false;        ///< before these some were left out
    std::size_t unread = 0;  ///< long messages before it that nobody wanted
};

/// What a port has carried since the first viewer came.
struct LineCount {
    std::uint64_t in = 0, out = 0;  ///< bytes to and from the device
    double rate = 0;                ///< bit/s of a serial line; 0: of none
};

/// What viewers have on their screens, by device. Of the rest they get a large
/// picture once a second.
struct Looks {
    bool all_heard = true;  ///< somebody has not said what
    bool all_said = false;  ///< somebody wants every byte
    std::set<std::string, std::less<>> heard{}, said{}, truth{};

    bool shows_heard(std::string_view device) const { return all_heard || heard.contains(device); }
    bool shows_said(std::string_view device) const { return all_said || said.contains(device); }
    /// Which object each bin hears.
    bool shows_truth(std::string_view device) const { return truth.contains(device); }
};

class Feed final : public Watch {
  public:
    using Moment = std::chrono::steady_clock::time_point;

    explicit Feed(std::function<Moment()> now = std::chrono::steady_clock::now) : now_(std::move(now)) {}

    /// While nobody looks, nothing is kept but the last that drivers said: it
    /// tells what they have set.
    void look(std::size_t viewers, Looks looks = {});
    std::size_t viewers() const { return viewers_; }

    /// Of each frequency: a large ping ten times a second where it is shown, else once. Objects of a
    /// large ping once a second, of small ones five times, always where they are
    /// shown; every 5 s while pings are late.
    Wanted wants_ping(std::string_view device, const Shot& shot) override;
    void ping(const SeenPing& ping) override;
    void bytes(const SeenBytes& bytes) override;
    void fault(const SeenFault& fault) override;

    /// What has come since the last call, oldest first; of large pictures the
    /// latest of each sonar and frequency.
    struct News {
        bool sparing = false;  ///< pings are late: what can wait had better
        std::vector<std::shared_ptr<const Kept>> pings;
        std::vector<Passed> passed;
        std::vector<bag::Fault> faults;
        std::size_t bytes_left_out = 0;  ///< there was too much to keep
    };
    News take();
    using Line = std::pair<std::string, std::string>;  ///< device and port
    std::map<Line, LineCount> lines() const;

  private:
    static constexpr std::chrono::seconds late_for{
        2};  ///< after a late ping: all sonars share the processors

    struct Sonar {
        Moment wanted{};          ///< when a large ping was asked for last
        Moment wanted_objects{};  ///< when objects were
        bool late = false;        ///< the last ping that was seen
        std::deque<std::shared_ptr<const Kept>> pings{};
    };

    bool is_sparing() const { return now_() - last_late_ < late_for; }
    void keep_for_later(const SeenBytes& seen);
    bool is_unwanted(const SeenBytes& seen);

    std::function<Moment()> now_;
    std::atomic<std::size_t> viewers_{0};
    mutable std::mutex mutex_;  // of all below
    Looks looks_{};
    Moment last_late_{};                                    ///< when a ping of any sonar was late
    std::map<std::pair<std::string, long>, Sonar> sonars_;  ///< by device and kHz: it may ping at two in turn
    std::map<Line, LineCount> lines_;
    std::set<std::pair<Line, bool>> gaps_;  ///< ways on which bytes were left out
    struct Long {
        Moment read{};
        std::size_t unread = 0;
    };
    std::map<Line, Long> long_;  ///< messages of sonars by TCP
    std::vector<Passed> passed_;
    std::deque<Passed> before_;  ///< what drivers said while nobody looked
    std::size_t before_bytes_ = 0;
    std::vector<bag::Fault> faults_;
    std::size_t passed_bytes_ = 0, left_out_ = 0;
};

}  // namespace echoloop::view
