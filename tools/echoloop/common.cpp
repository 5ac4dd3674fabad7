#include "tools/echoloop/common.h"

#include <cstdio>
#include <new>
#include <system_error>

namespace echoloop::cli {

std::string text_of(const Address& address) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8)
        text += std::to_string(address.ip >> shift & 0xFF) + (shift > 0 ? "." : "");
    return text + ":" + std::to_string(address.port);
}

std::string plain(double number, int decimals) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.*f", decimals, number);
    std::string text(buffer);
    if (text.find('.') == std::string::npos) return text;
    while (text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size() + 1), ' ');
    return text;
}

std::string counted(std::uint64_t number, const std::string& noun) {
    return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

void rethrow_lack_of_memory(const std::exception& error) {
    const auto* const told = dynamic_cast<const std::system_error*>(&error);
    if (told != nullptr && told->code() == std::errc::resource_unavailable_try_again) throw std::bad_alloc();
}

}  // namespace echoloop::cli
