// The options of an imaging head as typed values, and the ping that a command makes. Data and pure functions.
#pragma once

#include "emulator/devices/family/tritech/acoustics.h"
#include "emulator/devices/family/tritech/aux_echosounder.h"
#include "emulator/devices/family/tritech/bins.h"
#include "emulator/devices/family/tritech/head_options.h"
#include "emulator/devices/family/tritech/scan.h"

namespace echoloop::tritech {

/// Two families of imaging heads: DST, and SeaKing, SeaPrince and MiniKing.
enum class Family { dst, seaking };

/// Emulator options; the README.md of a model's folder explains each.
struct ImagingSettings {
    HeadSettings head;
    Acoustics acoustics;
    AuxSettings aux;
    ScanRules scan;
    Packing packing;
    bool obey_invert = true;
    bool v3b_counts = false;  ///< V3B of 0x1D instead of the main fields
    bool ping_pong = false;   ///< HdCtrl bit 11 alternates between the channels
    std::string period_law = "A";
    double period_scale = 1;
    double fixed_period = 0.05;  ///< s, for period_law "fixed"
    int device_type = 0x11;      ///< -1: HdType of the command
    int motor_error_after = 0;   ///< lines from the parameters to MotErr; 0: never
    int power_loss_every = 0;    ///< lines from one HdPwrLoss to the next; 0: never
    std::size_t most_bins = 1500;
};

ImagingSettings read_imaging_settings(const DeviceConfig& config, Family family);
void describe(ImagingSettings& settings, OptionList& options, FigureList& figures, Family family);

/// True if a head can work with these parameters at all.
bool usable(const seanet::HeadParameters& parameters);

/// The ping of a line: true range is NBins * ADInterval * 640 ns * c / 2.
Shot line_shot(const seanet::HeadParameters& parameters, const ImagingSettings& settings,
               const Tuning& tuning, std::uint16_t bearing);

/// The ping that a plain driver asks for at `step` of a turn of `turn_steps`: 500 bins over `range` m, 20 m
/// if that is 0.
Shot plain_shot(const DeviceConfig& config, Family family, std::size_t step, double range);
inline constexpr std::size_t turn_steps = 200;  ///< 1.8 deg each

}  // namespace echoloop::tritech
