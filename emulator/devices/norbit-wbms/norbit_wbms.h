// A Norbit WBMS multibeam: text commands, bathymetry and water column, each on a TCP port of its own. A pure
// state machine.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "emulator/contract/last_measured.h"
#include "emulator/contract/ping_pacer.h"
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
    void reconnected(std::size_t) override {}
    Actions connected(std::size_t port, Address peer, Time now) override;
    Actions disconnected(std::size_t port, Address peer, Time now) override;
    DeviceCounters counters() const override;

  private:
    /// A host on the command port.
    struct Commander {
        norbit::LineFramer lines;
        Time line_ends = Time::max();  ///< a command without a line's end is one then
    };

    void obey_line(const std::string& line, Address from, Time now);
    bool pinging() const;
    void plan_next_ping(Time now);
    void transmit(Time now);
    /// Whether the ping under way gets a water column; then the next one is an interval later.
    bool takes_image();
    /// To one host, or to all.
    void send(std::size_t port, Bytes bytes, Address to = {}) {
        actions_.send.push_back({port, std::move(bytes), to, {}});
    }
    /// s, by the time source that is set.
    double time_stamp(Time time) const;
    Actions take_actions();

    Settings settings_;
    Controls controls_;
    std::map<Address, Commander> commanders_;
    std::set<Address> viewers_;  ///< hosts on the water column
    PingRecord ping_;            ///< the ping under way, or the last one
    LastMeasured probe_;
    double digital_gain_ = 0;  ///< dB, of the next ping
    PingPacer pacer_{settings_.sensors, jitter::gate_array};
    std::optional<Time> last_image_;  ///< when its ping was due, at the rate of water columns
    Actions actions_;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::norbit_device
