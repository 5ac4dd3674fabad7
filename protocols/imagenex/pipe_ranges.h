// The ranges of an 831L and their codes: byte 3 of a command, byte 7 of its reply. Numbers only.
#pragma once

#include <array>
#include <cstdint>

namespace echoloop::imagenex {

struct PipeRange {
    std::uint8_t code;
    double metres;
    double filter_delay;  ///< m that one public reader adds to the profile range
};

inline constexpr std::array pipe_ranges{PipeRange{2, 0.125, 0.016}, PipeRange{4, 0.25, 0.016},
                                        PipeRange{6, 0.5, 0.016},   PipeRange{8, 0.75, 0.016},
                                        PipeRange{10, 1, 0.020},    PipeRange{20, 2, 0.024},
                                        PipeRange{30, 3, 0.030},    PipeRange{40, 4, 0.030},
                                        PipeRange{50, 5, 0.030},    PipeRange{60, 6, 0.030}};

/// Of a code, or of the next smaller one that there is.
constexpr const PipeRange& pipe_range(std::uint8_t code) {
    const PipeRange* found = &pipe_ranges.front();
    for (const PipeRange& range : pipe_ranges)
        if (range.code <= code) found = &range;
    return *found;
}

}  // namespace echoloop::imagenex
