// A sentence of the serial protocol of Water Linked's DVLs: "wrz,0.12,..*50" CR LF. Reads text in memory;
// never opens anything.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace echoloop::waterlinked {

/// CRC-8: polynomial 07, initial value 0, not reflected, no final exclusive or. "123456789" makes f4.
std::uint8_t crc8(std::string_view text);

struct Sentence {
    std::string address;                     ///< "wcv", "wrz", "wr?", "wr!"
    std::vector<std::string> fields{};       ///< as they stand; empty: null
    std::optional<std::uint8_t> checksum{};  ///< as it stands; commands may have none

    /// What the checksum is made of: "wrt,14.90,15.10".
    std::string body() const;
    /// True if there is no checksum.
    bool checksum_fits() const;
};

/// A line without its end; nothing if it is no sentence, or has something behind its checksum.
std::optional<Sentence> read_sentence(std::string_view line);
/// With CR LF, and with a checksum where it has one, which is written as it stands.
std::string write_sentence(const Sentence& sentence);
/// `body` with its checksum and CR LF.
std::string sentence(std::string_view body);

}  // namespace echoloop::waterlinked
