// How one value of a sweep comes about from run to run: one after the other, in every combination, or by
// chance. Knows no scenario.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/scenario/value.h"

namespace echoloop::scenario {

enum class Way { list, grid, choice, uniform, normal, log_uniform, sobol };

struct WayRow {
    Way way;
    std::string_view name;
};
inline constexpr std::array<WayRow, 7> ways{{{Way::list, "list"},
                                             {Way::grid, "grid"},
                                             {Way::choice, "choice"},
                                             {Way::uniform, "uniform"},
                                             {Way::normal, "normal"},
                                             {Way::log_uniform, "log_uniform"},
                                             {Way::sobol, "sobol"}}};

/// One path and how its value comes about.
struct Variation {
    std::string path;
    Place place;
    Way way = Way::list;
    std::vector<std::string> items;  ///< list, grid, choice: as flow text
    double first = 0, second = 1;    ///< bounds; normal: mean and standard deviation
    std::size_t dimension = 0;       ///< of Sobol's sequence
};

/// What belongs to (seed, index, key) alone, evenly spread over 64 bits.
std::uint64_t bits_of_run(std::uint64_t seed, const std::string& key, std::uint64_t index);

/// The value of run `index`, as flow text. `digit`: of a grid, which of its items; `dimensions`: of all paths
/// by Sobol's sequence.
std::string value_of_run(const Variation& variation, std::uint64_t seed, std::uint64_t index,
                         std::uint64_t digit, std::size_t dimensions);

}  // namespace echoloop::scenario
