#include "protocols/wire/crc.h"

#include <array>

namespace echoloop::wire {
namespace {

using Tables = std::array<std::array<std::uint32_t, 256>, 16>;

/// Of the reversed polynomial 0xEDB88320, for sixteen bytes at a time.
constexpr Tables make_tables() {
    Tables t{};
    for (std::uint32_t n = 0; n < 256; ++n) {
        std::uint32_t c = n;
        for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xEDB88320U ^ (c >> 1) : c >> 1;
        t[0][n] = c;
    }
    for (std::size_t k = 1; k < 16; ++k)
        for (std::size_t n = 0; n < 256; ++n) t[k][n] = t[0][t[k - 1][n] & 0xFF] ^ (t[k - 1][n] >> 8);
    return t;
}
constexpr Tables crc_tables = make_tables();

}  // namespace

std::uint32_t crc32(ByteView bytes) {
    const auto& t = crc_tables;
    std::uint32_t c = 0xFFFFFFFFU;
    std::size_t i = 0;
    const auto four = [](std::size_t table, std::uint32_t word) {
        return t[table + 3][word & 0xFF] ^ t[table + 2][word >> 8 & 0xFF] ^ t[table + 1][word >> 16 & 0xFF] ^
               t[table][word >> 24];
    };
    for (; i + 16 <= bytes.size(); i += 16) {
        const auto word = [&](std::size_t at) {
            return load<ByteOrder::little, std::uint32_t>(bytes.data() + i + at);
        };
        c = four(12, c ^ word(0)) ^ (four(8, word(4)) ^ four(4, word(8)) ^ four(0, word(12)));
    }
    for (; i < bytes.size(); ++i) c = t[0][(c ^ bytes[i]) & 0xFF] ^ (c >> 8);
    return ~c;
}

}  // namespace echoloop::wire
