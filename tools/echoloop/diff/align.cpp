#include "tools/echoloop/diff/align.h"

#include <algorithm>
#include <cstdint>
#include <functional>

namespace echoloop::diff {
namespace {

constexpr float gap_cost = 0.75F;
constexpr std::size_t least_band = 64;
constexpr std::size_t most_cells = std::size_t{64} << 20;

using Signature = std::vector<std::uint32_t>;  ///< of each field that tells messages apart

std::uint32_t hash_of(const std::string& name, const Value& value) {
    std::size_t sum = std::hash<std::string>{}(name);
    const auto add = [&sum](auto number) {
        sum = sum * 1099511628211U + std::hash<decltype(number)>{}(number);
    };
    if (const auto* number = std::get_if<double>(&value)) add(*number);
    if (const auto* text = std::get_if<std::string>(&value)) add(*text);
    if (const auto* numbers = std::get_if<std::vector<double>>(&value))
        for (const double one : *numbers) add(one);
    return static_cast<std::uint32_t>(sum ^ sum >> 32);
}

std::vector<Signature> signatures(const std::string& type, const std::vector<Message>& messages,
                                  const Rules& rules) {
    std::vector<Signature> out(messages.size());
    for (std::size_t i = 0; i < messages.size(); ++i)
        for (const NamedValue& field : messages[i].fields) {
            const Rule rule = rules.of(type, field.name);
            if (!rule.ignored && !rule.varies && !is_samples(field.value))
                out[i].push_back(hash_of(field.name, field.value));
        }
    return out;
}

float cost(const Signature& a, const Signature& b) {
    if (a.size() != b.size()) return 1;
    if (a.empty()) return 0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) different += a[i] != b[i] ? 1 : 0;
    return static_cast<float>(different) / static_cast<float>(a.size());
}

std::vector<Pair> in_order(std::size_t a, std::size_t b) {
    std::vector<Pair> out(std::max(a, b));
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (i < a) out[i].a = i;
        if (i < b) out[i].b = i;
    }
    return out;
}

/// Costs of the two sequences' beginnings, near the line that joins both ends; how each was reached is kept.
class Banded {
  public:
    Banded(const std::vector<Signature>& a, const std::vector<Signature>& b) : a_(a), b_(b) {
        const std::size_t difference = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
        band_ = difference + least_band;
        width_ = 2 * band_ + 1;
    }
    bool is_too_large() const { return (a_.size() + 1) > most_cells / width_; }

    std::vector<Pair> pairs() {
        steps_.assign((a_.size() + 1) * width_, Step::none);
        std::vector<float> before(width_, far), now(width_, far);
        for (std::size_t i = 0; i <= a_.size(); ++i) {
            fill_row(i, before, now);
            std::swap(before, now);
        }
        return walk_back();
    }

  private:
    enum class Step : std::uint8_t { none, both, only_a, only_b };
    static constexpr float far = 1e30F;

    /// Column of b's beginning of j messages in the row of a's of i; beyond `width_` if it lies outside.
    std::size_t column(std::size_t i, std::size_t j) const { return j + band_ - i; }
    bool inside(std::size_t i, std::size_t j) const { return j + band_ >= i && column(i, j) < width_; }

    void fill_row(std::size_t i, const std::vector<float>& before, std::vector<float>& now) {
        std::fill(now.begin(), now.end(), far);
        const std::size_t from = i > band_ ? i - band_ : 0, to = std::min(b_.size(), i + band_);
        for (std::size_t j = from; j <= to; ++j) {
            const std::size_t at = column(i, j);
            float best = i == 0 && j == 0 ? 0 : far;
            Step step = Step::none;
            const auto offer = [&](float value, Step how) {
                if (value < best) {
                    best = value;
                    step = how;
                }
            };
            if (i > 0 && j > 0) offer(before[at] + cost(a_[i - 1], b_[j - 1]), Step::both);
            if (i > 0 && at + 1 < width_) offer(before[at + 1] + gap_cost, Step::only_a);
            if (j > 0 && at > 0) offer(now[at - 1] + gap_cost, Step::only_b);
            now[at] = best;
            steps_[i * width_ + at] = step;
        }
    }

    std::vector<Pair> walk_back() const {
        std::vector<Pair> out;
        std::size_t i = a_.size(), j = b_.size();
        while (i > 0 || j > 0) {
            const Step step = inside(i, j) ? steps_[i * width_ + column(i, j)] : Step::none;
            if (step == Step::none) break;  // cannot be
            Pair pair;
            if (step != Step::only_b) pair.a = --i;
            if (step != Step::only_a) pair.b = --j;
            out.push_back(pair);
        }
        std::reverse(out.begin(), out.end());
        return out;
    }

    const std::vector<Signature>& a_;
    const std::vector<Signature>& b_;
    std::size_t band_ = 0, width_ = 0;
    std::vector<Step> steps_;
};

}  // namespace

std::vector<Pair> align(const std::string& type, const std::vector<Message>& a, const std::vector<Message>& b,
                        const Rules& rules) {
    const auto first = signatures(type, a, rules), second = signatures(type, b, rules);
    Banded banded(first, second);
    return banded.is_too_large() ? in_order(a.size(), b.size()) : banded.pairs();
}

}  // namespace echoloop::diff
