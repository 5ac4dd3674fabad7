#include "protocols/waterlinked/sentence.h"

#include <charconv>
#include <cstdio>

namespace echoloop::waterlinked {
namespace {

constexpr std::size_t address_size = 3;

bool is_address(std::string_view text) {
    const char last = text.back();
    const bool letter = (last >= 'a' && last <= 'z') || (last >= 'A' && last <= 'Z');
    if (text[0] != 'w') return false;
    return (text[1] == 'c' && letter) || (text[1] == 'r' && (letter || last == '?' || last == '!'));
}

/// Two hex digits and nothing else.
std::optional<std::uint8_t> read_checksum(std::string_view digits) {
    std::uint8_t value = 0;
    const auto* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value, 16);
    if (digits.size() != 2 || error != std::errc() || stop != end) return std::nullopt;
    return value;
}

std::string with_checksum(std::string_view body, std::uint8_t checksum) {
    char end[8];
    std::snprintf(end, sizeof end, "*%02x\r\n", unsigned{checksum});
    return std::string(body) + end;
}

}  // namespace

std::uint8_t crc8(std::string_view text) {
    unsigned crc = 0;
    for (const char c : text) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = (crc << 1U) ^ ((crc & 0x80U) != 0 ? 0x107U : 0U);
    }
    return static_cast<std::uint8_t>(crc);
}

std::string Sentence::body() const {
    std::string text = address;
    for (const std::string& field : fields) text.append(1, ',').append(field);
    return text;
}

bool Sentence::checksum_fits() const { return !checksum || *checksum == crc8(body()); }

std::optional<Sentence> read_sentence(std::string_view line) {
    if (line.size() < address_size || !is_address(line.substr(0, address_size))) return std::nullopt;
    Sentence sentence;
    sentence.address = line.substr(0, address_size);
    line.remove_prefix(address_size);
    if (const std::size_t star = line.find('*'); star != std::string_view::npos) {
        sentence.checksum = read_checksum(line.substr(star + 1));
        if (!sentence.checksum) return std::nullopt;
        line = line.substr(0, star);
    }
    if (line.empty()) return sentence;
    if (line[0] != ',') return std::nullopt;
    for (std::size_t comma = 0; comma != std::string_view::npos;) {
        line.remove_prefix(comma + 1);
        comma = line.find(',');
        sentence.fields.emplace_back(line.substr(0, comma));
    }
    return sentence;
}

std::string write_sentence(const Sentence& sentence) {
    const std::string body = sentence.body();
    return sentence.checksum ? with_checksum(body, *sentence.checksum) : body + "\r\n";
}

std::string sentence(std::string_view body) { return with_checksum(body, crc8(body)); }

}  // namespace echoloop::waterlinked
