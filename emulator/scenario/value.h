// A YAML document as plain values with their places. It holds no rule of the scenario format and no yaml-cpp
// type.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace echoloop::scenario {

/// Where a value was written: a line and column of the file (from 1), or one of the --set arguments.
struct Place {
    int line = 0;
    int column = 0;
    int set_argument = -1;  ///< index of the --set argument; -1: in the file
};

struct Value {
    enum class Kind { null, scalar, sequence, map };

    Kind kind = Kind::null;
    std::string text{};          ///< scalar: as written, quotes removed
    bool quoted = false;         ///< scalar: it was in quotes, so it is text even if it looks like a number
    std::vector<Value> items{};  ///< sequence: the elements; map: the values, in file order
    std::string key{};           ///< its key, if it is a value of a map
    Place key_place{};
    Place place{};

    bool is_map() const { return kind == Kind::map; }
    bool is_sequence() const { return kind == Kind::sequence; }
    bool is_scalar() const { return kind == Kind::scalar; }
    /// The first value of that key, or nullptr.
    const Value* find(std::string_view wanted) const;
    Value* find(std::string_view wanted);
};

/// "a list", "a map of keys", "text 'abc'", "a number 5", "nothing".
std::string describe(const Value& value);

/// Text from outside made safe to print: at most 60 bytes, control characters replaced.
std::string printable(std::string_view text);
/// The same in single quotes.
std::string in_quotes(std::string_view text);

}  // namespace echoloop::scenario
