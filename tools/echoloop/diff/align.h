// Which message of one capture is which of the other, of one type and direction. Looks at what the messages
// hold, never at their times.
#pragma once

#include <optional>
#include <vector>

#include "tools/echoloop/diff/rules.h"
#include "tools/echoloop/diff/side.h"

namespace echoloop::diff {

/// An array that is compared by its statistics.
inline bool is_samples(const Value& value) {
    const auto* numbers = std::get_if<std::vector<double>>(&value);
    return numbers != nullptr && numbers->size() > longest_exact_array;
}

/// Places in the two sequences; one of both is empty for a message that the other capture lacks.
struct Pair {
    std::optional<std::size_t> a, b;
};

/// The cheapest way to make one sequence the other: a pair costs the share of fields that differ, a message
/// without a partner 0.75. Sequences whose lengths differ by too much for that are paired in order.
std::vector<Pair> align(const std::string& type, const std::vector<Message>& a, const std::vector<Message>& b,
                        const Rules& rules);

}  // namespace echoloop::diff
