#include "protocols/norbit/command.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

namespace echoloop::norbit {
namespace {

constexpr std::size_t most_arguments = 16;

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_legal(char c) { return is_blank(c) || (c > ' ' && c <= '~'); }

}  // namespace

std::optional<Command> read_command(std::string_view line) {
    if (!std::all_of(line.begin(), line.end(), is_legal)) return std::nullopt;
    line = line.substr(0, line.find('#'));
    std::vector<std::string> words;
    for (std::size_t at = 0; at < line.size();) {
        const auto end = static_cast<std::size_t>(
            std::find_if(line.begin() + static_cast<std::ptrdiff_t>(at), line.end(), is_blank) -
            line.begin());
        if (end > at) words.emplace_back(line.substr(at, end - at));
        at = end + 1;
    }
    if (words.empty() || words.size() > 1 + most_arguments) return std::nullopt;
    Command command{std::move(words.front()), {}};
    command.arguments.assign(words.begin() + 1, words.end());
    return command;
}

std::string write_answer(const Command& command, std::string_view comment) {
    std::string line = command.name;
    for (const std::string& argument : command.arguments) line += ' ' + argument;
    if (!comment.empty()) line.append(" # ").append(comment);
    return line + "\r\n";
}

std::optional<double> read_number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::string write_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

std::string write_decimal(double value) {
    std::string text = write_number(value);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

void LineFramer::feed(wire::ByteView bytes) { buffer_.append(bytes.begin(), bytes.end()); }

std::optional<std::string> LineFramer::next() {
    while (true) {
        const std::size_t end = buffer_.find_first_of("\r\n");
        if (end == std::string::npos) break;
        std::string line = buffer_.substr(0, end);
        buffer_.erase(0, end + 1);
        if (std::exchange(too_long_, false) || line.size() > longest) {
            skipped_ += line.size() + 1;
            continue;
        }
        return line;
    }
    if (buffer_.size() > longest) {
        skipped_ += buffer_.size();
        buffer_.clear();
        too_long_ = true;
    }
    return std::nullopt;
}

std::string LineFramer::rest() {
    std::string line = std::exchange(buffer_, {});
    if (!std::exchange(too_long_, false)) return line;
    skipped_ += line.size();
    return {};
}

}  // namespace echoloop::norbit
