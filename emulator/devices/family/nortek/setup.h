// What hosts of Nortek's instruments set by SET, GET and GET..LIM: groups of keys with their legal values, as
// one table. Pure functions; knows no model.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace echoloop::nortek_console {

/// Of one key of a group: the words that it may have, or the numbers.
struct Row {
    std::string_view group, key, start;
    std::string_view words{};  ///< with commas between them; none: any number within the bounds
    double low = 0, high = 0;
    bool or_zero = false;  ///< 0 is legal, too
};
inline constexpr std::string_view on_off = "\"ON\",\"OFF\"";
inline constexpr std::string_view any_text = "*";  ///< as words: whatever stands in quotes

/// What a host sets: "TRIG" -> "FREQ" -> "4". Texts stand in quotes.
using Setup = std::map<std::string, std::map<std::string, std::string>, std::less<>>;

/// A table of rows, and what it makes of a host's words.
class Table {
  public:
    constexpr explicit Table(std::span<const Row> rows) : rows_(rows) {}

    Setup start() const;
    bool has(std::string_view group) const;
    /// All or nothing of "KEY=value" words, from the second on. Words without a key belong to the keys of
    /// `order`, from the first on; empty ones to none. Nothing if all is legal, else what is wrong.
    std::optional<std::string> set(Setup& setup, const std::string& group,
                                   const std::vector<std::string>& words,
                                   std::span<const std::string_view> order = {}) const;
    /// `name` and the group's keys with their values, or with their limits; of those keys alone that words
    /// name, from the second on.
    std::string values(std::string_view name, std::string_view group, const Setup& setup,
                       const std::vector<std::string>& words = {}) const;
    std::string limits(std::string_view name, std::string_view group,
                       const std::vector<std::string>& words = {}) const;

  private:
    const Row* row_of(std::string_view group, std::string_view key) const;
    std::span<const Row> rows_;
};

/// The value of a key; empty if there is none.
std::string value_of(const Setup& setup, std::string_view group, std::string_view key);
/// Of a number; `otherwise` where it is none.
double number_of(const Setup& setup, std::string_view group, std::string_view key, double otherwise);

}  // namespace echoloop::nortek_console
