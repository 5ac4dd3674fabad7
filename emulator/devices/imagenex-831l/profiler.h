// An Imagenex 831L pipe profiler: a command by TCP for each shot, a reply in one piece. A pure state machine.
#pragma once

#include <optional>

#include "emulator/devices/imagenex-831l/inclinometer.h"
#include "emulator/devices/imagenex-831l/settings.h"
#include "protocols/imagenex/framer.h"

namespace echoloop::imagenex831l {

class Profiler final : public Device {
  public:
    explicit Profiler(const Settings& settings)
        : settings_(settings), scan_(settings.start_position, settings.clip, settings.reverse_bit) {}

    std::vector<Port> ports() const override { return {{"commands", Port::Kind::stream, {}, false}}; }
    Actions started(Time) override { return {}; }
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time) override { return {}; }
    Actions located(std::span<const Located> places, Time now) override;
    void reconnected(std::size_t port) override;
    DeviceCounters counters() const override;

  private:
    void transmit(const imagenex::SwitchCommand& command, Time now);
    /// What the pitch and roll sensor says: new, or what it said last.
    void add_tilt(imagenex::PipeReply& reply) const;
    Actions take_actions();

    Settings settings_;
    imagenex_head::Scan scan_;
    imagenex::Framer framer_{imagenex::Framer::Takes::commands};
    std::optional<imagenex::SwitchCommand> current_;  ///< as it came, of the ping under way
    std::optional<imagenex::SwitchCommand> waiting_;  ///< came meanwhile; only the newest is kept
    Tilt tilt_, level_;                               ///< read last; as it was when it was calibrated
    bool tilt_is_new_ = false;
    std::uint64_t shots_ = 0;
    Actions actions_;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::imagenex831l
