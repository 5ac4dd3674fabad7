#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "render/renderer.h"

namespace echoloop {
namespace {

void require(bool good, const char* member, const std::string& limits) {
    if (!good) throw std::invalid_argument("shot: " + std::string(member) + " must be " + limits);
}

/// False for NaN.
bool within(double value, double low, double high) { return value >= low && value <= high; }

void check_bearings(const Shot& shot) {
    require(within(static_cast<double>(shot.bearings.size()), 1, 4096), "bearings", "1..4096 beams");
    for (std::size_t i = 0; i < shot.bearings.size(); ++i) {
        require(within(shot.bearings[i], -std::numbers::pi, std::numbers::pi), "bearings", "within +-pi");
        require(i == 0 || shot.bearings[i] > shot.bearings[i - 1], "bearings", "strictly ascending");
    }
    require(within(shot.beam_width, deg_to_rad(0.01), deg_to_rad(120)), "beam_width", "within 0.01..120 deg");
    require(shot.bearings.back() - shot.bearings.front() + shot.beam_width <= 2 * std::numbers::pi + 1e-9,
            "bearings", "at most 360 deg wide, beam_width included");
    require(within(shot.fan_height, deg_to_rad(0.01), deg_to_rad(120)), "fan_height", "within 0.01..120 deg");
    require(within(shot.pan, -2 * std::numbers::pi, 2 * std::numbers::pi), "pan", "within +-2 pi");
    require(within(shot.tilt, -std::numbers::pi / 2, std::numbers::pi / 2), "tilt", "within +-pi/2");
}

void check_rows(const Shot& shot) {
    constexpr double widest = deg_to_rad(60);
    if (shot.elevations.empty()) return;
    require(shot.bearings.size() >= 2 && within(static_cast<double>(shot.rows()), 2, 256) &&
                shot.beams() <= 65536,
            "elevations", "none, or 2..256 rows of 2 beams or more, 65536 beams in all");
    for (std::size_t i = 0; i < shot.rows(); ++i) {
        require(within(shot.elevations[i], -widest, widest), "elevations", "within +-60 deg");
        require(i == 0 || shot.elevations[i] > shot.elevations[i - 1], "elevations", "strictly ascending");
    }
    require(shot.bearings.front() >= -widest && shot.bearings.back() <= widest, "bearings",
            "within +-60 deg where there are rows");
}

void check_sides(const Shot& shot) {
    if (shot.sides.empty()) return;
    require(shot.sides.size() == shot.bearings.size() && shot.elevations.empty(), "sides",
            "none, or one for each bearing and no rows");
    for (const Side& side : shot.sides) {
        require(within(side.depression, -std::numbers::pi / 2, std::numbers::pi / 2), "sides.depression",
                "within +-pi/2");
        require(within(side.source_level, -300, 300), "sides.source_level", "within +-300 dB");
    }
}

void check_window(const Shot& shot) {
    require(within(static_cast<double>(shot.bins), 1, 65536), "bins", "within 1..65536");
    require(shot.bins * shot.beams() <= std::size_t{16} << 20, "bins",
            "at most 16 Mi for all beams together");
    require(within(shot.first_bin_time, 0, 60), "first_bin_time", "within 0..60 s");
    require(within(shot.bin_interval, 1e-7, 10), "bin_interval", "within 100 ns..10 s");
    require(shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval <= 60, "bins",
            "so few that the window ends within 60 s");
}

}  // namespace

void validate(const Shot& shot) {
    check_bearings(shot);
    check_rows(shot);
    check_sides(shot);
    check_window(shot);
    require(within(shot.frequency, 1e3, 1e7), "frequency", "within 1 kHz..10 MHz");
    require(within(shot.pulse_length, 0, 10), "pulse_length", "within 0..10 s");
    require(within(shot.bandwidth, 0, 1e7), "bandwidth", "within 0..10 MHz");
    require(within(shot.source_level, -300, 300), "source_level", "within +-300 dB");
}

}  // namespace echoloop
