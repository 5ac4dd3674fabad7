#include "protocols/nmea/sentence.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "protocols/nmea/sentences.h"

namespace echoloop::nmea {
namespace {

constexpr std::array depths{
    FieldRow{"feet", "ft", "depth, or null without a bottom"},        FieldRow{"f", "", "unit", 'f'},
    FieldRow{"metres", "m", "depth, or null without a bottom"},       FieldRow{"M", "", "unit", 'M'},
    FieldRow{"fathoms", "fathom", "depth, or null without a bottom"}, FieldRow{"F", "", "unit", 'F'},
};
constexpr std::array dpt_fields{
    FieldRow{"depth", "m", "below the transducer, or null without a bottom"},
    FieldRow{"offset", "m", "positive: up to the water line; negative: down to the keel"},
    FieldRow{"range", "m", "greatest depth of the range in use, from version 3.0 on"},
};
constexpr std::array mtw_fields{
    FieldRow{"temperature", "degC", "of the water"},
    FieldRow{"C", "", "unit", 'C'},
};
constexpr std::array rows{
    SentenceRow{"DBK", "depth below the keel", depths, depths.size()},
    SentenceRow{"DBS", "depth below the surface", depths, depths.size()},
    SentenceRow{"DBT", "depth below the transducer", depths, depths.size()},
    SentenceRow{"DPT", "depth", dpt_fields, 2},
    SentenceRow{"MTW", "temperature of the water", mtw_fields, mtw_fields.size()},
};

std::vector<std::string> split(std::string_view text) {
    std::vector<std::string> parts;
    for (std::size_t comma; (comma = text.find(',')) != std::string_view::npos; text.remove_prefix(comma + 1))
        parts.emplace_back(text.substr(0, comma));
    parts.emplace_back(text);
    return parts;
}

/// Two hex digits and nothing else.
std::optional<std::uint8_t> read_checksum(std::string_view digits) {
    std::uint8_t value = 0;
    const auto* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value, 16);
    if (digits.size() != 2 || error != std::errc() || stop != end) return std::nullopt;
    return value;
}

}  // namespace

std::string Sentence::body() const {
    std::string text = address;
    for (const std::string& field : fields) text.append(1, ',').append(field);
    return text;
}

bool Sentence::checksum_fits() const { return !checksum || *checksum == nmea::checksum(body()); }

std::optional<Sentence> read_sentence(std::string_view text) {
    if (text.empty() || (text[0] != '$' && text[0] != '!')) return std::nullopt;
    Sentence sentence;
    sentence.start = text[0];
    text.remove_prefix(1);
    if (const std::size_t star = text.find('*'); star != std::string_view::npos) {
        sentence.checksum = read_checksum(text.substr(star + 1));
        if (!sentence.checksum) return std::nullopt;
        text = text.substr(0, star);
    }
    sentence.fields = split(text);
    sentence.address = std::move(sentence.fields.front());
    sentence.fields.erase(sentence.fields.begin());
    if (sentence.address.empty()) return std::nullopt;
    return sentence;
}

std::string write_sentence(const Sentence& sentence) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string text = sentence.start + sentence.body();
    if (const auto sum = sentence.checksum) text += {'*', digits[*sum >> 4U], digits[*sum & 15U]};
    return text + "\r\n";
}

std::span<const SentenceRow> known_sentences() { return rows; }

const SentenceRow* find_row(std::string_view address) {
    constexpr std::size_t talker = 2, formatter = 3;
    if (address.size() != talker + formatter) return nullptr;
    const auto* row = std::find_if(rows.begin(), rows.end(), [&](const SentenceRow& one) {
        return one.formatter == address.substr(talker);
    });
    return row == rows.end() ? nullptr : row;
}

std::optional<double> read_number(std::string_view field) {
    const bool positive = field.starts_with('+');
    const std::string_view digits = field.substr(positive ? 1 : 0);
    double value = 0;
    const auto* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value, std::chars_format::fixed);
    const auto allowed = positive ? ".0123456789" : "-.0123456789";  // no "inf"
    const bool plain = digits.find_first_not_of(allowed) == std::string_view::npos;
    if (digits.empty() || !plain || error != std::errc() || stop != end) return std::nullopt;
    return value;
}

}  // namespace echoloop::nmea
