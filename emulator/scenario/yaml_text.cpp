#include "emulator/scenario/yaml_text.h"

#include <algorithm>
#include <cstdio>

namespace echoloop::scenario {
namespace {

/// Between double quotes every text is itself again.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            result += {'\\', c};
        } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
            char escape[5];
            std::snprintf(escape, sizeof escape, "\\x%02X", static_cast<unsigned char>(c));
            result += escape;
        } else {
            result += c;
        }
    }
    return result + "\"";
}

/// As it was written where that is safe anywhere in YAML.
std::string scalar_text(const std::string& text, bool was_quoted) {
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '.' || c == '/' || c == '+' || c == '-';
    };
    const bool safe = !text.empty() && !was_quoted && std::ranges::all_of(text, plain) && text != "-" &&
                      text != "---" && text != "...";
    return safe ? text : quoted(text);
}

void append_block(const Value& value, std::size_t depth, std::string& text) {
    const std::string margin(2 * depth, ' ');
    for (const Value& item : value.items) {
        const bool nested = (item.is_map() || item.is_sequence()) && !item.items.empty();
        text += margin + (value.is_map() ? scalar_text(item.key, false) + ":" : "-");
        text += nested ? "\n" : " " + flow_text(item) + "\n";
        if (nested) append_block(item, depth + 1, text);
    }
}

}  // namespace

std::string flow_text(const Value& value) {
    switch (value.kind) {
        case Value::Kind::null:
            return "null";
        case Value::Kind::scalar:
            return scalar_text(value.text, value.quoted);
        case Value::Kind::sequence:
        case Value::Kind::map:
            break;
    }
    std::string text;
    for (const Value& item : value.items) {
        if (!text.empty()) text += ", ";
        if (value.is_map()) text += scalar_text(item.key, false) + ": ";
        text += flow_text(item);
    }
    return value.is_map() ? "{" + text + "}" : "[" + text + "]";
}

std::string block_text(const Value& value) {
    if (!(value.is_map() || value.is_sequence()) || value.items.empty()) return flow_text(value) + "\n";
    std::string text;
    append_block(value, 0, text);
    return text;
}

}  // namespace echoloop::scenario
