// What a comparison of two captures found, as data. Draws no conclusion but "equal" or "different".
#pragma once

#include "tools/echoloop/diff/side.h"
#include "tools/echoloop/diff/spread.h"

namespace echoloop::diff {

enum class Verdict {
    equal,
    different,
    alike,        ///< samples: not the same, but by their rms within the limit
    not_compared  ///< differs by nature, or the user ignores it
};

struct Difference {
    Place a, b;
    std::string value_a, value_b;
};

struct FieldReport {
    std::string name, unit;
    Verdict verdict = Verdict::equal;
    std::size_t compared = 0, different = 0;
    std::optional<Difference> first{};  ///< the first place where they differ
    double largest = 0;                 ///< absolute difference of numbers
    double rms_a = 0, rms_b = 0;        ///< of samples
    bool samples = false;
    bool absent = false;  ///< somewhere one of both has not got it at all
    Spreads spreads{};    ///< over all messages, with a partner or without

    /// Both sides have it more than once, and it varies in one of them only.
    bool is_constant_once() const;
};

struct TypeReport {
    std::string name;
    std::size_t a = 0, b = 0, pairs = 0;
    std::vector<Place> only_a{}, only_b{};
    std::vector<FieldReport> fields{};
    // s
    Spread gap_a{}, gap_b{};          ///< between messages of this type
    Spread own_gap_a{}, own_gap_b{};  ///< the same by the times in the messages
    Spread answer_a{}, answer_b{};    ///< from this message to the next of the other side
    bool differs() const;
};

struct DirectionReport {
    std::string family{}, a{}, b{};  ///< "" for the side that has not got it
    std::vector<TypeReport> types{};
    std::size_t undecoded_a = 0, undecoded_b = 0;
    bool differs() const;
};

struct Report {
    std::string file_a{}, file_b{};
    std::size_t messages_a = 0, messages_b = 0;
    std::vector<DirectionReport> directions{};
    std::vector<std::string> warnings{};
    bool differs() const;
};

}  // namespace echoloop::diff
