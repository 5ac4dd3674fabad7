#include "tests/protocols/data.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace echoloop {

namespace {

unsigned digit(char c) {
    constexpr std::string_view lower = "0123456789abcdef";
    const std::size_t at = lower.find(static_cast<char>(c | 0x20));
    if (at == std::string_view::npos) throw std::invalid_argument(std::string("not a hex digit: ") + c);
    return static_cast<unsigned>(at);
}

wire::Bytes read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// What follows `word` in the line, if the line starts with it.
std::optional<std::string> after(const std::string& line, const std::string& word) {
    if (line.rfind(word, 0) != 0) return std::nullopt;
    return line.substr(word.size());
}

}  // namespace

wire::Bytes from_hex(std::string_view text) {
    std::string digits;
    std::copy_if(text.begin(), text.end(), std::back_inserter(digits),
                 [](char c) { return c != ' ' && c != '\t'; });
    if (digits.size() % 2 != 0) throw std::invalid_argument("half a byte in: " + digits);
    wire::Bytes bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2) {
        bytes.push_back(static_cast<std::uint8_t>(digit(digits[i]) * 16 + digit(digits[i + 1])));
    }
    return bytes;
}

std::string to_hex(wire::ByteView bytes) {
    std::string out;
    for (const std::uint8_t b : bytes) {
        out += "0123456789abcdef"[b >> 4];
        out += "0123456789abcdef"[b & 15];
    }
    return out;
}

HexFile read_hex_file(const std::filesystem::path& path) {
    HexFile out;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        line.resize(std::min(line.size(), line.find('#')));
        line.erase(line.find_last_not_of(" \t") + 1);
        if (const auto name = after(line, "message ")) {
            out.message = *name;
        } else if (const auto field = after(line, "field ")) {
            const std::size_t space = field->find(' ');
            out.fields.emplace_back(field->substr(0, space), field->substr(space + 1));
        } else {
            const wire::Bytes bytes = from_hex(line);
            out.bytes.insert(out.bytes.end(), bytes.begin(), bytes.end());
        }
    }
    return out;
}

std::vector<std::filesystem::path> hex_files(const std::string& family) {
    std::vector<std::filesystem::path> out;
    const std::filesystem::path folder = std::string(ECHOLOOP_SOURCE_DIR) + "/tests/data/" + family;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".hex") out.push_back(entry.path());
    }
    std::sort(out.begin(), out.end());
    return out;
}

std::optional<std::filesystem::path> shared_data(const std::string& name) {
    const std::filesystem::path path = std::string(ECHOLOOP_SOURCE_DIR) + "/../shared/data/" + name;
    if (!std::filesystem::exists(path)) return std::nullopt;
    return path;
}

std::vector<wire::Bytes> read_pcap(const std::filesystem::path& path) {
    constexpr std::size_t file_header = 24;
    constexpr std::size_t record_header = 16;
    constexpr std::size_t headers = 14 + 20 + 8;  // Ethernet, IPv4 without options, UDP
    const wire::Bytes file = read_file(path);
    std::vector<wire::Bytes> out;
    for (std::size_t at = file_header; at + record_header + headers <= file.size();) {
        const auto size = wire::load<wire::ByteOrder::little, std::uint32_t>(file.data() + at + 8);
        const auto first = file.begin() + static_cast<std::ptrdiff_t>(at + record_header);
        out.emplace_back(first + headers, first + size);
        at += record_header + size;
    }
    return out;
}

}  // namespace echoloop
