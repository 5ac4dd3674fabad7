// A received NMEA 0183 sentence in its parts, and the tables of those that echosounders and navigation units
// say. Reads text in memory; never opens anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace echoloop::nmea {

struct Sentence {
    char start = '$';                        ///< '!' for encapsulated binary
    std::string address;                     ///< "SDDPT"
    std::vector<std::string> fields;         ///< as they stand; empty: null
    std::optional<std::uint8_t> checksum{};  ///< as it stands; older talkers have none

    /// What the checksum is made of: "SDDPT,8.00,0.00".
    std::string body() const;
    /// True if there is no checksum.
    bool checksum_fits() const;
};

/// `text` as a Framer gives it; nothing if it is no sentence, or has something behind its checksum.
std::optional<Sentence> read_sentence(std::string_view text);
/// The sentence with CR LF, and with a checksum where it has one, which is written as it stands.
std::string write_sentence(const Sentence& sentence);

/// One field of a sentence: a number, or the letter of the number's unit before it, or any letters.
struct FieldRow {
    std::string_view name, unit, help;
    char letter = 0;  ///< 0: a number
};
inline constexpr char any_letters = '?';

struct SentenceRow {
    std::string_view formatter, help;
    std::span<const FieldRow> fields;
    std::size_t required = 0;  ///< fields that must be there, if only as null fields
};

/// In the order of their formatters.
std::span<const SentenceRow> known_sentences();
/// The row for an address of two letters of the talker and three of the formatter; nullptr if it is unknown.
const SentenceRow* find_row(std::string_view address);

/// A number as the standard writes them, "-0006.29"; nothing if it is none, or null.
std::optional<double> read_number(std::string_view field);

}  // namespace echoloop::nmea
