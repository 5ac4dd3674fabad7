#include "tools/echoloop/diff/spread.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "tools/echoloop/diff/side.h"

namespace echoloop::diff {
namespace {

using Numbers = std::vector<double>;

constexpr std::size_t most_values = 4'000'000, most_texts = 100'000;
/// Below this a histogram says nothing.
constexpr std::size_t least_values = 20, most_bins = 64;

/// Calls `each` with the field's value in every message that has it.
template <class Each>
void for_values(const std::string& field, const std::vector<Message>& messages, Each each) {
    std::size_t hint = 0;
    for (const Message& message : messages)
        if (const NamedValue* found = message.find(field, hint)) {
            hint = static_cast<std::size_t>(found - message.fields.data());
            each(found->value);
        }
}

/// Of very many numbers every n-th, and the least and the greatest.
Numbers numbers_of(const std::string& field, const std::vector<Message>& messages) {
    std::size_t count = 0;
    for_values(field, messages, [&count](const Value& value) {
        const auto* numbers = std::get_if<Numbers>(&value);
        count += numbers != nullptr ? numbers->size() : 1;
    });
    const std::size_t stride = count / most_values + 1;
    Numbers out;
    out.reserve(count / stride + 3);
    double least = HUGE_VAL, most = -HUGE_VAL;
    std::size_t number = 0;
    const auto add = [&](double value) {
        if (!std::isfinite(value)) return;
        least = std::min(least, value);
        most = std::max(most, value);
        if (number++ % stride == 0) out.push_back(value);
    };
    for_values(field, messages, [&add](const Value& value) {
        if (const auto* one = std::get_if<double>(&value)) add(*one);
        if (const auto* numbers = std::get_if<Numbers>(&value))
            for (const double one : *numbers) add(one);
    });
    if (stride > 1 && !out.empty()) out.insert(out.end(), {least, most});
    return out;
}

Spread texts_of(const std::string& field, const std::vector<Message>& messages) {
    std::set<std::string> texts;
    Spread out{.is_text = true};
    for_values(field, messages, [&](const Value& value) {
        const auto* text = std::get_if<std::string>(&value);
        if (text == nullptr) return;
        ++out.count;
        if (texts.size() < most_texts) texts.insert(*text);
    });
    out.distinct = texts.size();
    if (!texts.empty()) out.text = *texts.begin();
    return out;
}

/// Upper bounds of bins; the last bin has none.
Numbers edges_of(const Numbers& a, const Numbers& b) {
    Numbers both(a.size() + b.size());
    std::ranges::merge(a, b, both.begin());
    const double root = std::sqrt(static_cast<double>(std::min(a.size(), b.size())));
    const std::size_t bins = std::clamp<std::size_t>(static_cast<std::size_t>(root), 2, most_bins);
    Numbers edges;
    for (std::size_t i = 1; i < bins; ++i) edges.push_back(both[i * both.size() / bins]);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// The shares of sorted values that lie in each bin.
Numbers shares(const Numbers& values, const Numbers& edges) {
    Numbers out;
    auto begin = values.begin();
    for (std::size_t i = 0; i <= edges.size(); ++i) {
        const auto end = i < edges.size() ? std::upper_bound(begin, values.end(), edges[i]) : values.end();
        out.push_back(static_cast<double>(end - begin) / static_cast<double>(values.size()));
        begin = end;
    }
    return out;
}

double jensen_shannon(const Numbers& a, const Numbers& b) {
    if (std::min(a.size(), b.size()) < least_values) return -1;
    const Numbers edges = edges_of(a, b);
    const Numbers p = shares(a, edges), q = shares(b, edges);
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double middle = (p[i] + q[i]) / 2;
        if (p[i] > 0) sum += p[i] * std::log2(p[i] / middle) / 2;
        if (q[i] > 0) sum += q[i] * std::log2(q[i] / middle) / 2;
    }
    return std::sqrt(std::clamp(sum, 0.0, 1.0));
}

}  // namespace

Spread spread_of(Numbers& values) {
    Spread out{.count = values.size()};
    if (values.empty()) return out;
    std::ranges::sort(values);
    const std::size_t last = values.size() - 1;
    const auto count = static_cast<double>(values.size());
    out.least = values.front();
    out.most = values.back();
    out.median = values[last / 2];
    out.p05 = values[last * 5 / 100];
    out.p95 = values[last * 95 / 100];
    out.distinct = 1;
    for (std::size_t i = 1; i < values.size(); ++i) out.distinct += values[i] != values[i - 1] ? 1 : 0;
    for (const double value : values) out.mean += value / count;
    for (const double value : values) out.deviation += (value - out.mean) * (value - out.mean) / count;
    out.deviation = std::sqrt(out.deviation);
    return out;
}

Spreads spreads_of(const std::string& field, const std::vector<Message>& a, const std::vector<Message>& b) {
    Numbers in_a = numbers_of(field, a), in_b = numbers_of(field, b);
    Spreads out{spread_of(in_a), spread_of(in_b)};
    if (in_a.empty() && in_b.empty()) return {texts_of(field, a), texts_of(field, b)};
    out.distance = jensen_shannon(in_a, in_b);
    return out;
}

std::string text_of(const Spread& spread) {
    constexpr std::size_t shown = 40;
    if (spread.count == 0) return "none";
    if (spread.distinct == 1)
        return "constant " + (spread.is_text ? spread.text.substr(0, shown) : number_text(spread.least));
    const std::string values = std::to_string(spread.distinct) + " values";
    if (spread.is_text) return values;
    return values + ", " + number_text(spread.least) + " to " + number_text(spread.most) + ", median " +
           number_text(spread.median);
}

std::string number_text(double value) {
    char text[32];
    const bool whole = std::trunc(value) == value && std::abs(value) < 1e15;
    std::snprintf(text, sizeof text, whole ? "%.0f" : "%.9g", value + 0.0);
    return text;
}

}  // namespace echoloop::diff
