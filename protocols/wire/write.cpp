#include "protocols/wire/write.h"

namespace echoloop::wire {

void write_hex4(std::uint64_t value, std::uint8_t* to) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    for (std::size_t i = 0; i < 4; ++i)
        to[i] = static_cast<std::uint8_t>(digits[(value >> (12 - 4 * i)) & 0xF]);
}

}  // namespace echoloop::wire
