// Text of files that may hold anything.
#pragma once

#include <cctype>
#include <string>

namespace echoloop::worlds {

/// Fit for one line of a message or for a table.
inline std::string printable(const std::string& text, std::size_t most = 200) {
    std::string out;
    for (const char c : text.substr(0, most))
        out += static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
    return out + (text.size() > most ? "..." : "");
}

inline std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

}  // namespace echoloop::worlds
