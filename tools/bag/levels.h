// A picture made small enough to be looked at: whole steps of a scale, few beams and bins. Opens nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/echogram.h"
#include "tools/said/said.h"

namespace echoloop::bag {

/// How a picture's beams and bins lie in those that there are: at most 1,024 beams and 512 bins. Rows of
/// several are kept.
struct Grouping {
    std::size_t rows, columns, all_bins;  ///< that there are
    std::size_t beams, bins;              ///< of one row of the picture
    std::size_t per_beam, per_bin;

    Grouping(std::size_t rows, std::size_t columns, std::size_t bins);

    /// The greatest of each group, beam by beam, of `values` (all rows, columns and bins); -inf where a group
    /// holds no number. With `places` also where each stands.
    std::vector<float> greatest(const std::vector<float>& values, std::vector<std::size_t>* places) const;
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
/// The same; counts of 8 bits stay as they are. Without bytes where the message tells ranges alone.
Levels levels_of(const said::Picture& picture);
/// Of each beam of `levels_of(picture)` the first range that one of its group tells; 0: none.
std::vector<float> ranges_of(const said::Picture& picture);

}  // namespace echoloop::bag
