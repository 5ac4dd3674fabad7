#include "emulator/devices/family/nortek/setup.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "emulator/devices/family/nortek/lines.h"

namespace echoloop::nortek_console {
namespace {

/// Calls `use` with each of the words that have commas between them.
template <class Use>
void each_word(std::string_view words, const Use& use) {
    while (!words.empty()) {
        const std::size_t comma = std::min(words.find(','), words.size());
        use(words.substr(0, comma));
        words.remove_prefix(std::min(comma + 1, words.size()));
    }
}

bool is_legal(const Row& row, std::string_view value) {
    if (row.words == any_text)
        return value.size() >= 2 && value.front() == '"' && value.back() == '"' &&
               value.find('"', 1) == value.size() - 1;
    if (!row.words.empty()) {
        bool found = false;
        each_word(row.words, [&](std::string_view word) { found = found || word == value; });
        return found;
    }
    const auto number = number_in(value);
    return number && ((*number >= row.low && *number <= row.high) || (row.or_zero && *number == 0));
}

std::string limits_of(const Row& row) {
    if (row.words == any_text) return "[\"\"]";
    if (row.words.empty()) {
        std::array<char, 64> numbers{};
        std::snprintf(numbers.data(), numbers.size(), row.or_zero ? "([0;0];[%g;%g])" : "([%g;%g])", row.low,
                      row.high);
        return numbers.data();
    }
    std::string words(row.words);
    std::ranges::replace(words, ',', ';');
    return '[' + words + ']';
}

/// Whether `key` is asked for: all are, if no word names any.
bool is_wanted(std::string_view key, const std::vector<std::string>& words) {
    return words.size() < 2 || std::find(words.begin() + 1, words.end(), key) != words.end();
}

}  // namespace

Setup Table::start() const {
    Setup setup;
    for (const Row& row : rows_) setup[std::string(row.group)][std::string(row.key)] = row.start;
    return setup;
}

bool Table::has(std::string_view group) const {
    return std::ranges::find(rows_, group, &Row::group) != rows_.end();
}

const Row* Table::row_of(std::string_view group, std::string_view key) const {
    const auto found =
        std::ranges::find_if(rows_, [&](const Row& r) { return r.group == group && r.key == key; });
    return found == rows_.end() ? nullptr : &*found;
}

std::optional<std::string> Table::set(Setup& setup, const std::string& group,
                                      const std::vector<std::string>& words,
                                      std::span<const std::string_view> order) const {
    auto changed = setup[group];
    std::size_t place = 0;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        const bool named = equals != std::string::npos;
        if (!named && place < order.size() && words[i].empty()) ++place;
        if (words[i].empty()) continue;
        if (!named && place == order.size()) return "Unknown parameter " + words[i];
        const std::string key(named ? std::string_view(words[i]).substr(0, equals) : order[place++]);
        if (key.empty() && !named) continue;  // one that has no meaning any more
        const Row* row = row_of(group, key);
        if (row == nullptr) return "Unknown parameter " + key;
        const std::string value = named ? words[i].substr(equals + 1) : words[i];
        if (!is_legal(*row, value)) return "Invalid value of " + key;
        changed[key] = value;
    }
    setup[group] = changed;
    return std::nullopt;
}

std::string Table::values(std::string_view name, std::string_view group, const Setup& setup,
                          const std::vector<std::string>& words) const {
    std::string line(name);
    for (const Row& row : rows_)
        if (row.group == group && is_wanted(row.key, words))
            line += ',' + std::string(row.key) + '=' + value_of(setup, group, row.key);
    return line;
}

std::string Table::limits(std::string_view name, std::string_view group,
                          const std::vector<std::string>& words) const {
    std::string line(name);
    for (const Row& row : rows_)
        if (row.group == group && is_wanted(row.key, words))
            line += ',' + std::string(row.key) + '=' + limits_of(row);
    return line;
}

std::string value_of(const Setup& setup, std::string_view group, std::string_view key) {
    const auto keys = setup.find(group);
    if (keys == setup.end()) return {};
    const auto found = keys->second.find(std::string(key));
    return found == keys->second.end() ? std::string() : found->second;
}

double number_of(const Setup& setup, std::string_view group, std::string_view key, double otherwise) {
    return number_in(value_of(setup, group, key)).value_or(otherwise);
}

}  // namespace echoloop::nortek_console
