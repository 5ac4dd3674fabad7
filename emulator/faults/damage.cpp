// What faults do to the bytes of a message: lose, double, cut and change them.
#include <algorithm>
#include <cmath>

#include "emulator/contract/options.h"
#include "emulator/faults/pieces.h"
#include "emulator/transport/uart.h"

namespace echoloop {
namespace {

constexpr std::size_t most_copies = 1000;  // of one message, by however many faults

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Where numbers with decimals begin, and where their points are.
std::vector<std::pair<std::size_t, std::size_t>> decimals(const std::string& text) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (std::size_t point = 1; point + 1 < text.size(); ++point) {
        if (text[point] != '.' || !is_digit(text[point - 1]) || !is_digit(text[point + 1])) continue;
        std::size_t begin = point;
        while (begin > 0 && is_digit(text[begin - 1])) --begin;
        if (begin > 0 && (text[begin - 1] == '-' || text[begin - 1] == '+')) --begin;
        found.emplace_back(begin, point);
    }
    return found;
}

/// That of NMEA 0183, if the line has one.
void renew_checksum(std::string& line) {
    const std::size_t star = line.rfind('*');
    if (!line.starts_with('$') || star == std::string::npos || star + 2 >= line.size()) return;
    unsigned sum = 0;
    for (std::size_t i = 1; i < star; ++i) sum ^= static_cast<unsigned char>(line[i]);
    constexpr std::string_view digits = "0123456789ABCDEF";
    line[star + 1] = digits[sum >> 4 & 15];
    line[star + 2] = digits[sum & 15];
}

}  // namespace

bool Pieces::happens(const AskedFault& asked, const Dice& dice) {
    return dice.uniform() < number(asked.fault.parameters, "rate");
}

FaultEvent Pieces::event(const AskedFault& asked) const {
    FaultEvent event;
    event.kind = asked.fault.kind;
    event.id = asked.id;
    if (faults_.sent_ping() > 0) event.ping = faults_.sent_ping();
    event.message = message_;
    return event;
}

/// Nothing is left of the message at hand; the fault's own events tell of it.
bool Pieces::unplugged(Time now) {
    bool is = false;
    faults_.each(FaultKind::unplug, place_, now, [&is](AskedFault& asked) {
        is = true;
        ++asked.swallowed;
    });
    return is;
}

/// True if nothing is left of it but the record of its loss.
bool Pieces::lose(Piece& piece, Time now) {
    const auto lost = [&](const AskedFault& asked) {
        if (!piece.events.empty()) return;
        piece.events.push_back(event(asked));
        piece.events.back().length = piece.bytes.size();
    };
    faults_.each(FaultKind::silence, place_, now, lost);
    faults_.each(FaultKind::loss, place_, now, [&](const AskedFault& asked) {
        if (happens(asked, asked.dice.of(message_))) lost(asked);
    });
    if (piece.events.empty()) return false;
    piece.bytes.clear();
    return true;
}

std::vector<Piece> Pieces::copies(Piece piece, Time now) {
    std::vector<Piece> all{std::move(piece)};
    faults_.each(FaultKind::duplication, place_, now, [&](const AskedFault& asked) {
        if (!happens(asked, asked.dice.of(message_))) return;
        for (std::size_t i = 0; i < whole(asked, "copies") && all.size() < most_copies; ++i) {
            Piece copy = all.front();
            copy.events.push_back(event(asked));
            copy.events.back().length = copy.bytes.size();
            all.push_back(std::move(copy));
        }
    });
    return all;
}

void Pieces::damage(Piece& piece, std::uint64_t copy, Time now) {
    faults_.each(FaultKind::bad_numbers, place_, now,
                 [&](const AskedFault& asked) { spoil_number(piece, asked, copy); });
    faults_.each(FaultKind::baud_mismatch, place_, now,
                 [&](const AskedFault& asked) { garble(piece, asked); });
    faults_.each(FaultKind::wrong_checksum, place_, now,
                 [&](const AskedFault& asked) { spoil_checksums(piece, asked, copy); });
    faults_.each(FaultKind::truncation, place_, now,
                 [&](const AskedFault& asked) { cut(piece, asked, copy); });
    faults_.each(FaultKind::bit_flips, place_, now,
                 [&](const AskedFault& asked) { flip(piece, asked, copy); });
}

void Pieces::spoil_number(Piece& piece, const AskedFault& asked, std::uint64_t copy) {
    const Dice dice = asked.dice.of(message_).of(copy);
    if (!happens(asked, dice)) return;
    std::string text(piece.bytes.begin(), piece.bytes.end());
    const auto numbers = decimals(text);
    if (numbers.empty()) return;
    const auto [begin, point] = numbers[dice.below(numbers.size(), 1)];
    text.insert(point + 1, "-");
    if (text[begin] != '-') text.insert(begin, "-");
    renew_checksum(text);
    FaultEvent made = event(asked);
    made.offset = begin;
    made.length = point + 2 - begin;
    piece.bytes.assign(text.begin(), text.end());
    piece.events.push_back(std::move(made));
}

void Pieces::garble(Piece& piece, const AskedFault& asked) {
    const double other = number(asked.fault.parameters, "baud");
    const double right = piece.line_rate > 0 ? piece.line_rate : traits_.line_rate;
    if (traits_.line_rate <= 0 || uart::agree(other, right)) return;
    const bool heard = place_.direction == Towards::from_driver;
    FaultEvent made = event(asked);
    made.details = {{"baud", other}, {"was", static_cast<std::int64_t>(piece.bytes.size())}};
    piece.bytes =
        heard ? uart::as_heard(piece.bytes, right, {other}) : uart::as_heard(piece.bytes, other, {right});
    made.length = piece.bytes.size();
    piece.events.push_back(std::move(made));
}

void Pieces::spoil_checksums(Piece& piece, const AskedFault& asked, std::uint64_t copy) {
    if (traits_.find_checksums == nullptr) return;
    const Dice message = asked.dice.of(message_).of(copy);
    for (const ChecksumPlace& place : traits_.find_checksums(piece.bytes)) {
        const Dice dice = message.of(place.offset);
        if (!happens(asked, dice)) continue;
        const std::size_t at = place.offset + dice.below(place.size, 1);
        std::uint8_t& byte = piece.bytes[at];
        const auto before = std::int64_t{byte};
        if (place.hex_digits) {
            const std::string_view digits = byte >= 'a' ? "0123456789abcdef" : "0123456789ABCDEF";
            const std::size_t digit = std::min(digits.find(static_cast<char>(byte)), std::size_t{15});
            byte = static_cast<std::uint8_t>(digits[(digit + 1 + dice.below(15, 2)) % 16]);
        } else {
            byte ^= static_cast<std::uint8_t>(1 + dice.below(255, 2));
        }
        FaultEvent made = event(asked);
        made.offset = at;
        made.length = 1;
        made.details = {{"was", before}, {"is", std::int64_t{byte}}};
        piece.events.push_back(std::move(made));
    }
}

void Pieces::cut(Piece& piece, const AskedFault& asked, std::uint64_t copy) {
    const Dice dice = asked.dice.of(message_).of(copy);
    const std::size_t keep = whole(asked, "keep"), size = piece.bytes.size();
    if (size < 2 || keep >= size || !happens(asked, dice)) return;
    const std::size_t left = keep > 0 ? keep : 1 + dice.below(size - 1, 1);
    piece.bytes.resize(left);
    std::erase_if(piece.events, [left](const FaultEvent& earlier) { return earlier.offset >= left; });
    FaultEvent made = event(asked);
    made.offset = left;
    made.length = size - left;
    piece.events.push_back(std::move(made));
}

/// Bytes from a driver come in whatever parts the system reads them: there the place in the stream counts.
void Pieces::flip(Piece& piece, const AskedFault& asked, std::uint64_t copy) {
    const double byte_rate = 1 - std::pow(1 - number(asked.fault.parameters, "rate"), 8);
    const bool heard = place_.direction == Towards::from_driver;
    const Dice dice = heard ? asked.dice : asked.dice.of(message_).of(copy);
    const std::uint64_t first = heard ? position_ : 0;
    for (std::size_t i = 0; i < piece.bytes.size(); ++i) {
        if (dice.uniform(2 * (first + i)) >= byte_rate) continue;
        const auto bit = static_cast<std::int64_t>(dice.below(8, 2 * (first + i) + 1));
        piece.bytes[i] ^= static_cast<std::uint8_t>(1U << bit);
        FaultEvent made = event(asked);
        made.offset = i;
        made.length = 1;
        made.details = {{"bit", bit}};
        piece.events.push_back(std::move(made));
    }
}

}  // namespace echoloop
