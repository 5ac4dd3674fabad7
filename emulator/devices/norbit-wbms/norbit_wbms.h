// A Norbit WBMS multibeam: text commands, bathymetry and water column, each on a TCP port of its own. A pure
// state machine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/devices/norbit-wbms/packets.h"

namespace echoloop::norbit_device {

class NorbitWbms final : public Device {
  public:
    explicit NorbitWbms(const Settings& settings);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override;
    Actions disconnected(std::size_t port, Time now) override;
    DeviceCounters counters() const override;

  private:
    void obey_line(const std::string& line, Time now);
    bool pinging() const;
    void plan_next_ping(Time now);
    void transmit(Time now);
    void send(std::size_t port, Bytes bytes) { actions_.send.push_back({port, std::move(bytes), {}, {}}); }
    /// s, by the time source that is set.
    double time_stamp(Time time) const;
    Actions take_actions();

    Settings settings_;
    Controls controls_;
    norbit::LineFramer lines_;
    PingRecord ping_;  ///< the ping under way, or the last one
    bool ping_under_way_ = false;
    bool images_wanted_ = false;  ///< somebody is connected to the water column
    double digital_gain_ = 0;     ///< dB, of the next ping
    std::optional<Time> last_transmission_;
    Time next_ping_ = Time::max();
    Time line_ends_ = Time::max();  ///< a command without a line's end is one then
    Actions actions_;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::norbit_device
