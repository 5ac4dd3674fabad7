#include "emulator/contract/receiver_notation.h"

#include <charconv>
#include <optional>
#include <stdexcept>
#include <string>

namespace echoloop {
namespace {

/// Reads a text from its beginning; what fails names the rest of it.
class Reader {
  public:
    Reader(std::string_view text, std::string_view notation)
        : text_(text), rest_(text), notation_(notation) {}

    bool done() {
        skip();
        return rest_.empty();
    }
    bool take(std::string_view word) {
        skip();
        if (!rest_.starts_with(word)) return false;
        rest_.remove_prefix(word.size());
        return true;
    }
    void expect(std::string_view word) {
        if (!take(word)) fail("expected \"" + std::string(word) + "\"");
    }
    double number(double least, double most, std::string_view what) {
        const auto value = try_number();
        if (!value) fail("expected " + std::string(what));
        if (!(*value >= least && *value <= most))
            fail(std::string(what) + " must lie between " + short_text(least) + " and " + short_text(most));
        return *value;
    }
    std::optional<double> try_number() {
        skip();
        double value = 0;
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (error != std::errc{}) return {};
        before_ = rest_;
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return value;
    }
    [[noreturn]] void fail(const std::string& why) const {
        const std::string_view where = before_.size() > rest_.size() ? before_ : rest_;
        throw std::invalid_argument(why + " at character " + std::to_string(text_.size() - where.size() + 1) +
                                    " of \"" + std::string(text_.substr(0, 200)) + "\"; " +
                                    std::string(notation_));
    }

  private:
    static std::string short_text(double value) {
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        return {digits, end};
    }
    void skip() {
        before_ = {};
        while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\n')) rest_.remove_prefix(1);
    }

    std::string_view text_, rest_, notation_;
    std::string_view before_;  ///< what the last number began with
};

constexpr double most_db = 300, most_spread = 40;

RingDown::Point read_point(Reader& in) {
    constexpr double ms = 1e-3, longest = 1000;
    RingDown::Point point;
    point.time = ms * in.number(0, longest, "a time in ms");
    in.expect(":");
    point.level = in.number(-most_db, 0, "a level in dB re the source level");
    if (in.take("+-")) point.scatter = in.number(0, most_spread, "a scatter in dB");
    if (in.take("~")) point.lasting = in.number(0, most_spread, "a lasting scatter in dB");
    return point;
}

void read_bearings(Reader& in, RingDown& ring) {
    constexpr std::size_t least = 2, most = 360;
    constexpr double furthest = 10;
    while (!in.done() && ring.bearings.size() <= most)
        ring.bearings.push_back(in.number(-furthest, furthest, "a factor of ~"));
    if (ring.bearings.size() < least || ring.bearings.size() > most)
        in.fail("2 to 360 bearings are possible, got " + std::to_string(ring.bearings.size()));
}

}  // namespace

std::shared_ptr<const RingDown> read_ring_down(std::string_view text) {
    if (text == "none") return nullptr;
    constexpr std::size_t most_points = 100;
    Reader in(text, ring_down_notation);
    auto ring = std::make_shared<RingDown>();
    if (in.take("pulse")) {
        ring->pulse = 1e-3 * in.number(0.001, 100, "a pulse in ms");
        in.expect(";");
    }
    do {
        const RingDown::Point point = read_point(in);
        if (!ring->points.empty() && point.time <= ring->points.back().time)
            in.fail("each time must be later than the one before");
        ring->points.push_back(point);
        if (ring->points.size() > most_points) in.fail("more than 100 points");
    } while (in.take(","));
    if (in.take(";")) {
        in.expect("bearings");
        read_bearings(in, *ring);
    }
    if (!in.done()) in.fail("expected the end");
    return ring;
}

std::shared_ptr<const Interference> read_interference(std::string_view text) {
    if (text == "none") return nullptr;
    Reader in(text, interference_notation);
    auto rule = std::make_shared<Interference>();
    do {
        if (rule->lines == 0 && in.take("lines")) {
            rule->lines = in.number(0, 100, "a share in %") / 100;
            in.expect("%");
            in.expect("by");
            rule->lift = in.number(0, 60, "a lift in dB");
            if (in.take("+-")) rule->lift_spread = in.number(0, most_spread, "a spread in dB");
        } else if (rule->dashes == 0 && in.take("dashes")) {
            rule->dashes = in.number(0, 10'000, "dashes per s");
            in.expect("per s at");
            rule->dash_level = in.number(-most_db, most_db, "a level in dB re 1 uPa");
            if (in.take("+-")) rule->dash_spread = in.number(0, most_spread, "a spread in dB");
        } else if (in.take("beams")) {
            constexpr double most_beams = 65536;
            Interference::Stripe stripe;
            const double first = in.number(0, most_beams, "the first beam, from 0 on");
            in.expect("-");
            const double last = in.number(first, most_beams, "the last beam");
            in.expect("of");
            const double all = in.number(last + 1, most_beams, "the number of beams");
            in.expect("by");
            stripe.lift = in.number(0, 60, "a lift in dB");
            stripe.first = first / all;
            stripe.last = (last + 1) / all;
            rule->stripes.push_back(stripe);
        } else {
            in.fail("expected \"lines\", \"dashes\" or \"beams\", each of the first two once");
        }
        in.expect("dB");
    } while (in.take(";"));
    if (!in.done()) in.fail("expected the end");
    return rule;
}

}  // namespace echoloop
