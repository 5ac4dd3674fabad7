// An echosounder that pings by itself, finds the bottom and says its depth in lines of text. A pure state
// machine; what the lines say is its model's own.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/family/sounder/sounding.h"
#include "emulator/devices/family/sounder/tracker.h"
#include "emulator/devices/family/talker/wiring.h"

namespace echoloop::echosounder {

using talker::read_wiring;
using talker::Wiring;

class TalkingSounder : public Device {
  public:
    /// The lines of one ping heard at `now`, in order; the depth in m below the transducer, or nothing
    /// without a bottom.
    using Words = std::function<std::vector<std::string>(std::optional<double> depth, Time now)>;

    TalkingSounder(const Sounding& sounding, std::vector<Wiring> wiring, Words words,
                   bool free_running = true);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    /// It listens to nobody: what comes is counted.
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t) override {}
    DeviceCounters counters() const override { return counters_; }

  protected:
    /// From now on it pings only when it is asked, as here; a ping under way is as good an answer.
    void ask(Time now);
    /// From now on it pings by itself, at its rate.
    void run_freely(Time now);
    /// It pings no more, and the ping under way is not heard.
    void stop() { pacer_.stop(); }
    /// From the next ping on; the line's rate stays.
    void change(const Sounding& sounding);
    /// A line beside those of pings, to all who listen.
    void say(const std::string& line);
    Actions take_actions();
    DeviceCounters counters_;
    Time other_wake_ = Time::max();  ///< when woken() is wanted besides

  private:
    void ping_if_due(Time now);

    Sounding sounding_;
    std::vector<Wiring> wiring_;
    Words words_;
    Shot shot_;          ///< of the last ping
    bool free_running_;  ///< from the start
    PingPacer pacer_{sounding_.sensors, jitter::processor};
    Tracker tracker_;
    Actions actions_;  ///< of the call at hand
};

}  // namespace echoloop::echosounder
