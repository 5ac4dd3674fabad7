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
constexpr std::array gga_fields{
    FieldRow{"time", "", "UTC, hhmmss.ss"},
    FieldRow{"latitude", "", "ddmm.m..; degrees and minutes"},
    FieldRow{"north_south", "", "N or S", any_letters},
    FieldRow{"longitude", "", "dddmm.m.."},
    FieldRow{"east_west", "", "E or W", any_letters},
    FieldRow{"quality", "", "0 none, 1 alone, 2 with corrections, 4 to the centimetre, 5 nearly so"},
    FieldRow{"satellites", "", "in use"},
    FieldRow{"dilution", "", "of the horizontal position"},
    FieldRow{"altitude", "m", "above the sea's mean level"},
    FieldRow{"M", "", "unit", 'M'},
    FieldRow{"separation", "m", "of the sea's mean level from the ellipsoid"},
    FieldRow{"M", "", "unit", 'M'},
    FieldRow{"age", "s", "of the corrections"},
    FieldRow{"station", "", "that makes them"},
};
constexpr std::array gst_fields{
    FieldRow{"time", "", "UTC, hhmmss.ss"},
    FieldRow{"rms", "m", "of the ranges"},
    FieldRow{"major_axis", "m", "of the ellipse of errors"},
    FieldRow{"minor_axis", "m", "of the ellipse of errors"},
    FieldRow{"orientation", "deg", "of its major axis"},
    FieldRow{"latitude_error", "m", "standard deviation"},
    FieldRow{"longitude_error", "m", "standard deviation"},
    FieldRow{"height_error", "m", "standard deviation"},
};
constexpr std::array hdt_fields{
    FieldRow{"heading", "deg", "clockwise from true north"},
    FieldRow{"T", "", "true", 'T'},
};
constexpr std::array vtg_fields{
    FieldRow{"course", "deg", "over ground, clockwise from true north"},
    FieldRow{"T", "", "true", 'T'},
    FieldRow{"magnetic_course", "deg", "null where it is not known"},
    FieldRow{"M", "", "magnetic", 'M'},
    FieldRow{"speed_in_knots", "kn", "over ground"},
    FieldRow{"N", "", "unit", 'N'},
    FieldRow{"speed", "km/h", "over ground"},
    FieldRow{"K", "", "unit", 'K'},
    FieldRow{"mode", "", "A alone, D with corrections, N not valid; from version 2.3 on", any_letters},
};
constexpr std::array zda_fields{
    FieldRow{"time", "", "UTC, hhmmss.ss"},
    FieldRow{"day", "", "1 to 31"},
    FieldRow{"month", "", "1 to 12"},
    FieldRow{"year", "", "four digits"},
    FieldRow{"zone_hours", "h", "of local time"},
    FieldRow{"zone_minutes", "min", "of local time"},
};
constexpr std::array pashr_fields{
    FieldRow{"time", "", "UTC, hhmmss.sss"},
    FieldRow{"heading", "deg", "clockwise from true north"},
    FieldRow{"T", "", "true", 'T'},
    FieldRow{"roll", "deg", "port up"},
    FieldRow{"pitch", "deg", "bow up"},
    FieldRow{"heave", "m", "up"},
    FieldRow{"roll_error", "deg", "standard deviation"},
    FieldRow{"pitch_error", "deg", "standard deviation"},
    FieldRow{"heading_error", "deg", "standard deviation"},
    FieldRow{"quality", "", "of the position: 0 none, 1 any, 2 to the centimetre"},
    FieldRow{"aligned", "", "0 not yet, 1 it is"},
};
constexpr std::array rows{
    SentenceRow{"DBK", "depth below the keel", depths, depths.size()},
    SentenceRow{"DBS", "depth below the surface", depths, depths.size()},
    SentenceRow{"DBT", "depth below the transducer", depths, depths.size()},
    SentenceRow{"DPT", "depth", dpt_fields, 2},
    SentenceRow{"GGA", "position", gga_fields, gga_fields.size()},
    SentenceRow{"GST", "errors of the position", gst_fields, gst_fields.size()},
    SentenceRow{"HDT", "heading", hdt_fields, hdt_fields.size()},
    SentenceRow{"MTW", "temperature of the water", mtw_fields, mtw_fields.size()},
    SentenceRow{"SHR", "attitude, in PASHR", pashr_fields, 10},
    SentenceRow{"VTG", "course and speed over ground", vtg_fields, 8},
    SentenceRow{"ZDA", "date and time", zda_fields, 4},
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
