#include "emulator/replay/command.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

namespace echoloop::replay {
namespace {

/// Fields that say what is asked for rather than with which figure.
bool is_kind(std::string_view field) {
    constexpr std::array kinds{"requested_id", "id",      "type",        "command",  "address",
                               "mode",         "profile", "data_points", "report_id"};
    return std::ranges::find(kinds, field) != kinds.end();
}

/// Fields that differ from one message to the next whatever is asked.
bool is_volatile(std::string_view field) {
    constexpr std::array parts{"time", "checksum", "crc", "sequence", "reserved", "record_number", "cookie"};
    return std::ranges::any_of(parts, [&](const char* part) { return field.find(part) != field.npos; });
}

std::string first_line(wire::ByteView bytes) {
    constexpr std::size_t longest = 1024;
    std::string line;
    for (const std::uint8_t byte : bytes.first(std::min(bytes.size(), longest))) {
        if (byte == '\r' || byte == '\n') break;
        line += static_cast<char>(byte);
    }
    return line;
}

bool is_text(std::string_view line) {
    return !line.empty() &&
           std::ranges::all_of(line, [](char c) { return c == '\t' || (c >= ' ' && c <= '~'); });
}

std::optional<double> number_of(std::string_view word) {
    double number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(number)) return {};
    return number;
}

}  // namespace

Command command_of(const inspect::Message& message) {
    Command command{message.name, {}};
    for (const auto& field : message.fields) {
        if (is_volatile(field.name)) continue;
        if (is_kind(field.name)) {
            command.key += " " + field.name + " " + field.text;
        } else if (field.number) {
            command.values.emplace_back(field.name, std::isfinite(*field.number) ? *field.number : 0);
        } else if (field.numbers.empty()) {
            command.key += " " + field.text;
        }
    }
    return command;
}

Command command_of(wire::ByteView bytes) {
    const std::string line = first_line(bytes);
    if (!is_text(line)) return {std::string(bytes.begin(), bytes.end()), {}};
    Command command;
    std::string_view rest = line;
    while (!rest.empty()) {
        const auto word = rest.substr(0, rest.find_first_of(" ,\t"));
        rest.remove_prefix(std::min(rest.size(), word.size() + 1));
        if (const auto number = number_of(word)) {
            command.values.emplace_back(std::to_string(command.values.size()), *number);
        } else if (!word.empty()) {
            command.key += (command.key.empty() ? "" : " ") + std::string(word);
        }
    }
    return command;
}

Command command_of(const http::Request& request) {
    constexpr std::string_view marks = " \t\r\n{}[]:,\"";
    constexpr std::size_t most = 64;  // words of a body
    Command command{request.method + " " + request.target, {}};
    std::string_view rest = request.body;
    while (command.values.size() < most) {
        rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(marks)));
        if (rest.empty()) break;
        const auto word = rest.substr(0, rest.find_first_of(marks));
        rest.remove_prefix(word.size());
        const auto number = number_of(word);
        // A word counts as one number among very many, so that two of them differ by about as much as they
        // can.
        const double value =
            number ? *number : static_cast<double>(std::hash<std::string_view>{}(word) % 1'000'000'007);
        command.values.emplace_back(number ? "number" : "word", value);
    }
    return command;
}

double distance(const Command& a, const Command& b) {
    double sum = std::abs(static_cast<double>(a.values.size()) - static_cast<double>(b.values.size()));
    for (std::size_t i = 0; i < std::min(a.values.size(), b.values.size()); ++i) {
        const auto& [name, value] = a.values[i];
        const auto& [other_name, other] = b.values[i];
        const double size = std::abs(value) + std::abs(other);
        if (name != other_name || !std::isfinite(size)) {
            sum += 1;
        } else if (size > 0) {
            sum += std::abs(value - other) / size;
        }
    }
    return sum;
}

}  // namespace echoloop::replay
