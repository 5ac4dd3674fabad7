#include "emulator/run/token.h"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "emulator/contract/error.h"

namespace echoloop {

std::string random_token() {
    constexpr char digits[] = "0123456789abcdef";
    std::array<std::uint8_t, 16> random{};
    if (::getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size()))
        throw StartError(Exit::unavailable,
                         std::string("no random numbers for a token: ") + std::strerror(errno));
    std::string token;
    for (const std::uint8_t byte : random) {
        token += digits[byte >> 4];
        token += digits[byte & 15];
    }
    return token;
}

}  // namespace echoloop
