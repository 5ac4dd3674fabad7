// An Imagenex 872 side-scan: a command by TCP for each side of a ping, a reply for each. A pure state
// machine.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "emulator/devices/imagenex-872/settings.h"
#include "protocols/imagenex/framer.h"

namespace echoloop::imagenex872 {

class Imagenex872 final : public Device {
  public:
    explicit Imagenex872(const Settings& settings) : settings_(settings) {}

    std::vector<Port> ports() const override { return {{"line", Port::Kind::stream, {}, false}}; }
    Actions started(Time) override { return {}; }
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time) override { return {}; }
    void reconnected(std::size_t port) override;
    DeviceCounters counters() const override;

  private:
    void obey(const imagenex::SwitchCommand& command, Time now);
    void transmit(const imagenex::SwitchCommand& command, Time now);
    /// The reply with a side of the last ping.
    Bytes reply(std::size_t side) const;
    Actions take_actions();

    Settings settings_;
    imagenex::Framer framer_{imagenex::Framer::Takes::commands};
    imagenex::SwitchCommand command_;  ///< of the ping under way, or of the last one
    std::vector<std::size_t> wanted_;  ///< sides of the ping under way, in their order
    bool under_way_ = false, holds_starboard_ = false;
    std::array<std::vector<std::uint8_t>, 2> samples_;  ///< of the last ping
    std::uint64_t shots_ = 0;
    Actions actions_;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::imagenex872
