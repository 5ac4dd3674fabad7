// An echogram made small enough to be looked at: whole steps of a scale, few beams and bins. Opens nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/echogram.h"

namespace echoloop::bag {

/// How a picture's beams and bins lie in the echogram's: at most 1,024 beams and 512 bins.
struct Grouping {
    std::size_t rows, beams, bins, per_beam, per_bin;  ///< beams: of one row of the picture

    explicit Grouping(const Shot& shot);
};

/// Levels of a picture. A byte is 0 for nothing, else floor + (byte - 1) step.
struct Levels {
    std::size_t rows = 1, beams = 0, bins = 0;
    std::vector<double> bearings{};        ///< rad, of each beam of a row, clockwise from `pan`
    double pan = 0, beam_width = 0;        ///< rad
    bool sides = false;                    ///< each beam has an array of its own
    bool waterfall = false;                ///< of a side-scan
    bool down = false;                     ///< the middle looks down, not ahead
    double first_range = 0, bin_size = 0;  ///< m
    double floor = 0, step = 1;            ///< dB, or what the device counts
    double span = 60;                      ///< of those, below the loudest that are shown
    std::optional<double> noise{};         ///< the same
    std::string bytes{};                   ///< rows x beams x bins
    std::string objects{};  ///< of the same bins, two bytes each (little endian); "" where nobody asked

    /// `bin` of all of a row's.
    std::uint8_t at(std::size_t beam, std::size_t bin) const {
        return static_cast<std::uint8_t>(bytes[beam * bins + bin]);
    }
    double farthest() const { return first_range + static_cast<double>(bins) * bin_size; }
};

/// Several bins of the echogram make one: the loudest is shown. Steps of 0.5 dB below the loudest of all.
Levels levels_of(const Echogram& echogram);

}  // namespace echoloop::bag
