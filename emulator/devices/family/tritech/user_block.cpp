#include "emulator/devices/family/tritech/user_block.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <stdexcept>

#include "emulator/devices/family/tritech/head_options.h"
#include "protocols/seanet/codec.h"

namespace echoloop::tritech {
namespace {

constexpr std::size_t older_rest = 27;         // bytes from 147 on, of the form of 175 bytes
constexpr std::size_t longest_file = 1 << 16;  // characters; a block has 250 bytes

bool is_hex(const std::string& text) {
    return std::all_of(text.begin(), text.end(),
                       [](unsigned char c) { return std::isxdigit(c) || std::isspace(c) || c == ','; });
}

std::string text_of_file(const std::string& name, const std::string& option) {
    std::ifstream file(name);
    if (!file)
        throw std::invalid_argument("option '" + option + "': '" + name +
                                    "' is neither hex digits nor a file that can be read");
    std::string all;
    for (std::string line; all.size() < longest_file && std::getline(file, line);)
        all += line.substr(0, line.find('#')) + ' ';
    return all;
}

/// Settings of the AUX port in BBUserData: 9600 baud, the echosounder's usual rate.
constexpr std::uint16_t baud_9600 = 3, baud_115200 = 7;

}  // namespace

std::vector<std::uint8_t> hex_bytes(const std::string& text, const std::string& option) {
    const std::string source = is_hex(text) ? text : text_of_file(text, option);
    std::string digits;
    std::copy_if(source.begin(), source.end(), std::back_inserter(digits),
                 [](unsigned char c) { return !std::isspace(c) && c != ','; });
    if (!is_hex(digits) || digits.size() % 2 != 0)
        throw std::invalid_argument("option '" + option + "': give pairs of hex digits, e.g. \"5D, 4D\"");
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
    return bytes;
}

void put_front(std::span<std::uint8_t> content, const std::vector<std::uint8_t>& bytes,
               const std::string& option) {
    if (bytes.size() > content.size())
        throw std::invalid_argument("option '" + option + "' has " + std::to_string(bytes.size()) +
                                    " bytes; there is room for " + std::to_string(content.size()));
    std::copy(bytes.begin(), bytes.end(), content.begin());
}

seanet::BBUserData make_user_block(bool dst, bool half_duplex, bool older, const std::string& content) {
    seanet::BBUserData block;
    block.a0.baud_low = block.a0.baud_high = baud_115200;
    block.a1.baud_low = block.a1.baud_high = baud_9600;
    (dst ? block.half_duplex_dst : block.half_duplex) = half_duplex ? 1 : 0;
    if (!dst) {
        block.device_marker = 0;
        block.block1[0] = 1;  // hasMotor
    }
    if (older) block.rest.resize(older_rest);
    seanet::Frame frame = seanet::make_frame(block);
    put_front(frame.payload, hex_bytes(content, "user_block"), "user_block");
    return std::get<seanet::BBUserData>(*seanet::parse(frame));
}

}  // namespace echoloop::tritech
