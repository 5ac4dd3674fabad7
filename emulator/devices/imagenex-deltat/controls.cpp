#include "emulator/devices/imagenex-deltat/controls.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "emulator/devices/imagenex-deltat/settings.h"

namespace echoloop::delta_t {
namespace {

// By the codes of an EC.
constexpr unsigned range_choices[] = {5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 250, 300};
constexpr unsigned first_range_code = 2;
constexpr unsigned sectors[] = {30, 60, 90, 120};
constexpr double beam_widths[] = {3, 1.5, 0.75, 0.75};
constexpr unsigned beam_counts[] = {480, 240, 120};
constexpr unsigned most_gain = 20, most_averaging = 10;

constexpr double pulses[] = {30e-6,  60e-6,  120e-6, 180e-6, 240e-6,
                             300e-6, 360e-6, 480e-6, 600e-6};  // by range
constexpr std::size_t bins_in_range = 1000;

/// The value of a code, if there is one.
template <class T, std::size_t N>
void look_up(const T (&values)[N], unsigned code, T& out) {
    if (code < N) out = values[code];
}

double in_water(std::uint16_t tenths, double otherwise) {
    const double speed = tenths / 10.0;
    return speed >= 1400 && speed <= 1600 ? speed : otherwise;
}

double sound_speed(std::uint16_t big, double before, SpeedOrder order) {
    const auto little = static_cast<std::uint16_t>(big << 8 | big >> 8);
    if (order == SpeedOrder::little) return in_water(little, before);
    return in_water(big, order == SpeedOrder::automatic ? in_water(little, before) : before);
}

}  // namespace

Controls after(const imagenex::ExternalControl& c, const Controls& before, const Controls& start,
               SpeedOrder order) {
    if (c.external == 0) return start;
    Controls next = before;
    look_up(range_choices, c.range - first_range_code, next.range);
    look_up(sectors, c.sector, next.sector);
    look_up(beam_widths, c.beam_width, next.beam_width);
    look_up(beam_counts, c.beams, next.beams);
    if (c.gain <= most_gain) next.gain = c.gain;
    if (c.averaging <= most_averaging) next.averaging = std::max<unsigned>(1, c.averaging);
    next.sound_speed = sound_speed(c.sound_speed, before.sound_speed, order);
    next.minimum_range = c.minimum_range;
    next.tilt = c.tilt - 180;
    next.transmit = c.receive_only != 1;
    next.roll_compensation = c.roll_compensation != 0;
    return next;
}

bool alike(Controls a, const Controls& b) {
    a.sound_speed = b.sound_speed;
    a.tilt = b.tilt;
    a.minimum_range = b.minimum_range;
    return a == b;
}

std::vector<double> Fan::angles() const {
    std::vector<double> out(beams);
    for (std::size_t n = 0; n < beams; ++n)
        out[n] = deg_to_rad((start + static_cast<double>(n) * increment) / 100);
    return out;
}

Fan fan_of(const Controls& controls) {
    const int sector = 100 * static_cast<int>(controls.sector), beams = static_cast<int>(controls.beams);
    const int increment = sector / beams;
    // Where hundredths do not fill the sector, its middle stays on the axis.
    return {-sector / 2 + (sector - increment * beams) / 2, increment, controls.beams};
}

double window(const Controls& controls) { return 2 * controls.range / nominal_sound_speed; }

double pulse_length(const Controls& controls) {
    const auto* at = std::find(std::begin(range_choices), std::end(range_choices), controls.range);
    const auto place = static_cast<std::size_t>(at - std::begin(range_choices));
    return pulses[std::min(place, std::size(pulses) - 1)];
}

Shot make_shot(const Controls& controls, const Acoustics& acoustics, std::uint64_t ping, double roll,
               double period) {
    constexpr double nothing = -300;  // dB
    Shot shot;
    shot.ping = ping;
    shot.bearings = fan_of(controls).angles();
    for (double& bearing : shot.bearings) bearing += roll;
    shot.beam_width = deg_to_rad(controls.beam_width);
    shot.fan_height = acoustics.fan_height;
    shot.pulse_length = pulse_length(controls);
    shot.bin_interval = window(controls) / bins_in_range;
    // An echo from the end of the range lasts a pulse and its decay longer.
    shot.bins = bins_in_range + static_cast<std::size_t>(2 * shot.pulse_length / shot.bin_interval);
    shot.frequency = acoustics.frequency;
    shot.source_level = controls.transmit ? acoustics.source_level : nothing;
    shot.horizontal = acoustics.horizontal;
    shot.vertical = acoustics.vertical;
    shot.receiver = acoustics.receiver;
    shot.errors = acoustics.errors;
    shot.receiver.saturation_level -= controls.gain;
    shot.interval = period;
    return shot;
}

}  // namespace echoloop::delta_t
