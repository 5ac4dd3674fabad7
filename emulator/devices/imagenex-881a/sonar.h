// An Imagenex 881A scanning sonar on its RS-485 pair, and by option the azimuth drive that carries it. A pure
// state machine.
#pragma once

#include "emulator/devices/family/imagenex/head.h"
#include "emulator/devices/family/imagenex/scan.h"

namespace echoloop::imagenex881a {

using imagenex_head::ahead, imagenex_head::angle_of, imagenex_head::circle;

/// Emulator options beside those of all Imagenex heads; README.md of this folder explains each.
struct Settings {
    imagenex_head::Settings head{.head_id = 0x10, .status = 0x41};
    bool clip = false;
    int start_position = ahead;
    bool azimuth_drive = false;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);

class Sonar final : public imagenex_head::Head {
  public:
    explicit Sonar(const Settings& settings);

  protected:
    imagenex::SwitchCommand usable(imagenex::SwitchCommand command) const override;
    double resolution(const imagenex::SwitchCommand& command) const override;
    Time aim(const imagenex::SwitchCommand& command, Shot& shot) override;
    imagenex::Packed14 position_bytes() const override;
    std::uint64_t profile_units(double range, const imagenex::SwitchCommand& command) const override;
    bool obey_other(const wire::Bytes& frame, Time now) override;

  private:
    imagenex_head::Scan scan_;
    bool azimuth_drive_;
    int azimuth_ = ahead;  ///< of the drive, positions
};

/// Frequency of byte 25 in Hz.
double frequency_of(const imagenex::SwitchCommand& command);
/// What the frequency and the pulse of a command make of a shot.
void set_sound(const imagenex::SwitchCommand& command, double design_frequency, Shot& shot);

/// The row of the table of models.
Model model();

}  // namespace echoloop::imagenex881a
