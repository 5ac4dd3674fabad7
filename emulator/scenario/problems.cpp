#include "emulator/scenario/problems.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace echoloop {
namespace {

std::string lines_of(const std::vector<Problem>& problems) {
    std::string text;
    for (const auto& problem : problems) text += (text.empty() ? "" : "\n") + problem.text();
    return text;
}

Exit exit_of(const std::vector<Problem>& problems) {
    const auto all = [&](Problem::Kind kind) {
        return std::ranges::all_of(problems, [&](const Problem& problem) { return problem.kind == kind; });
    };
    if (all(Problem::Kind::missing_file)) return Exit::no_input;
    return all(Problem::Kind::no_permission) ? Exit::no_permission : Exit::config;
}

}  // namespace

ScenarioError::ScenarioError(std::vector<Problem> problems)
    : StartError(exit_of(problems), lines_of(problems)), problems_(std::move(problems)) {}

namespace scenario {
namespace {

constexpr std::size_t most_problems = 100;

/// Edit distance with insertion, deletion, substitution and the swap of two neighbours (Damerau, optimal
/// string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before = std::exchange(last, row);
    }
    return last[b.size()];
}

}  // namespace

void Problems::add(const Place& place, std::string message, Problem::Kind kind) {
    if (problems_.size() > most_problems) return;
    if (problems_.size() == most_problems) message = "and more; these are the first 100";
    const bool in_file = place.set_argument < 0;
    problems_.push_back(
        {kind, where(place), in_file ? place.line : 0, in_file ? place.column : 0, std::move(message)});
}

void Problems::append(const Problems& other) {
    const auto sorted = other.in_order();
    appended_.insert(appended_.end(), sorted.begin(), sorted.end());
}

std::vector<Problem> Problems::in_order() const {
    auto sorted = problems_;
    std::ranges::stable_sort(sorted, {}, [](const Problem& p) { return std::pair(p.line, p.column); });
    sorted.insert(sorted.end(), appended_.begin(), appended_.end());
    return sorted;
}

std::string Problems::where(const Place& place) const {
    if (place.set_argument >= 0)
        return "--set " + printable(set_arguments_.at(static_cast<std::size_t>(place.set_argument)));
    if (place.line == 0) return file_;
    return file_ + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

void Problems::throw_if_any() const {
    if (empty()) return;
    throw ScenarioError(in_order());
}

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& known) {
    constexpr std::size_t longest = 40;
    if (word.size() > longest) return {};
    std::string_view best;
    std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const auto candidate : known) {
        const auto distance = edit_distance(word, candidate);
        if (distance < best_distance) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

namespace {

/// "'egl-surfaceless' or 'egl-device'" of 'egl': those that hold the word; "" if none does.
std::string holding(std::string_view word, const std::vector<std::string_view>& known) {
    constexpr std::size_t shortest = 3;
    std::string list;
    if (word.size() < shortest) return list;
    for (const auto candidate : known)
        if (candidate.find(word) != std::string_view::npos)
            list += (list.empty() ? "" : " or ") + in_quotes(candidate);
    return list;
}

}  // namespace

std::string suggestion(std::string_view word, const std::vector<std::string_view>& known) {
    const auto near = nearest(word, known);
    if (!near.empty()) return "; did you mean " + in_quotes(near) + "?";
    if (const auto longer = holding(word, known); !longer.empty()) return "; did you mean " + longer + "?";
    if (known.empty()) return "; there are none";
    std::string list;
    for (const auto candidate : known) list += (list.empty() ? "" : ", ") + std::string(candidate);
    return "; known are: " + list;
}

}  // namespace scenario
}  // namespace echoloop
