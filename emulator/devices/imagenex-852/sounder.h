// An Imagenex 852 echo sounder on its RS-485 pair, and by option with the external trigger. A pure state
// machine.
#pragma once

#include "emulator/devices/family/imagenex/head.h"

namespace echoloop::imagenex852 {

/// Emulator options beside those of all Imagenex heads; README.md of this folder explains each.
struct Settings {
    imagenex_head::Settings head{.head_id = 0x11, .status = 0x45};
    imagenex::Packed14 position_bytes{0x0A << 7 | 0x78};  ///< bytes 5 and 6
    double trigger_rate = 0;  ///< pulses per s on the trigger input; 0: there is none
};

void describe(Settings& settings, OptionList& options, FigureList& figures);

class Sounder final : public imagenex_head::Head {
  public:
    explicit Sounder(const Settings& settings);

  protected:
    imagenex::SwitchCommand usable(imagenex::SwitchCommand command) const override;
    double resolution(const imagenex::SwitchCommand& command) const override;
    Time aim(const imagenex::SwitchCommand& command, Shot& shot) override;
    imagenex::Packed14 position_bytes() const override { return position_bytes_; }
    std::uint64_t profile_units(double range, const imagenex::SwitchCommand& command) const override;
    Time transmit_time(const imagenex::SwitchCommand& command, Time now) override;
    Time next_by_itself(const imagenex::SwitchCommand& command, Time now) override;

  private:
    bool is_triggered(const imagenex::SwitchCommand& command) const;
    bool is_automatic(const imagenex::SwitchCommand& command) const;
    Time next_pulse(Time now) const;

    imagenex::Packed14 position_bytes_;
    double trigger_rate_;
};

/// m, of the profile range and of the samples.
inline constexpr double range_resolution = 0.02;

/// The row of the table of models.
Model model();

}  // namespace echoloop::imagenex852
