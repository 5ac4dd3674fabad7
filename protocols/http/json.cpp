#include "protocols/http/json.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace echoloop::http {
namespace {

/// Reads values off the front of the text; every function says false, for good, at what it cannot read.
class Parser {
  public:
    explicit Parser(std::string_view text) : text_(text) {}

    std::optional<Json> document() {
        Json value;
        skip_space();
        const bool fine =
            take('{') ? read_object(value.emplace<JsonObject>()) : read_scalar(value.emplace<JsonScalar>());
        skip_space();
        if (!fine || !text_.empty()) return std::nullopt;
        return value;
    }

  private:
    void skip_space() {
        while (!text_.empty() && std::string_view(" \t\r\n").find(text_.front()) != std::string_view::npos)
            text_.remove_prefix(1);
    }
    bool take(char c) {
        if (text_.empty() || text_.front() != c) return false;
        text_.remove_prefix(1);
        return true;
    }
    bool take(std::string_view word) {
        if (!text_.starts_with(word)) return false;
        text_.remove_prefix(word.size());
        return true;
    }

    /// Behind the '{'.
    bool read_object(JsonObject& object) {
        skip_space();
        if (take('}')) return true;
        while (true) {
            std::string key;
            skip_space();
            if (!read_string(key)) return false;
            skip_space();
            if (!take(':')) return false;
            skip_space();
            if (!read_scalar(object[key])) return false;
            skip_space();
            if (take('}')) return true;
            if (!take(',')) return false;
        }
    }

    bool read_scalar(JsonScalar& value) {
        if (take("null")) return value = std::monostate{}, true;
        if (take("true")) return value = true, true;
        if (take("false")) return value = false, true;
        if (!text_.empty() && text_.front() == '"') return read_string(value.emplace<std::string>());
        return read_number(value.emplace<double>());
    }

    /// from_chars takes "inf" and ".5" as well, which are no JSON.
    bool read_number(double& value) {
        const std::size_t digit = text_.starts_with('-') ? 1 : 0;
        if (digit >= text_.size() || text_[digit] < '0' || text_[digit] > '9') return false;
        const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
        if (error != std::errc() || !std::isfinite(value)) return false;
        text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
        return true;
    }

    bool read_string(std::string& out) {
        if (!take('"')) return false;
        while (!text_.empty()) {
            const char c = text_.front();
            text_.remove_prefix(1);
            if (c == '"') return true;
            if (static_cast<unsigned char>(c) < ' ') return false;
            if (c != '\\')
                out += c;
            else if (!read_escape(out))
                return false;
        }
        return false;
    }

    /// Behind the backslash.
    bool read_escape(std::string& out) {
        constexpr std::string_view letters = "\"\\/bfnrt", meaning = "\"\\/\b\f\n\r\t";
        if (text_.empty()) return false;
        const char c = text_.front();
        text_.remove_prefix(1);
        if (c == 'u') return read_code(out);
        const std::size_t at = letters.find(c);
        if (at == std::string_view::npos) return false;
        out += meaning[at];
        return true;
    }

    /// Four hex digits, as UTF-8. Halves of a pair are written as they are.
    bool read_code(std::string& out) {
        unsigned code = 0;
        if (text_.size() < 4) return false;
        const auto [end, error] = std::from_chars(text_.data(), text_.data() + 4, code, 16);
        if (error != std::errc() || end != text_.data() + 4) return false;
        text_.remove_prefix(4);
        if (code < 0x80) {
            out += static_cast<char>(code);
        } else if (code < 0x800) {
            out += {static_cast<char>(0xC0 | code >> 6), static_cast<char>(0x80 | (code & 0x3F))};
        } else {
            out += {static_cast<char>(0xE0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3F)),
                    static_cast<char>(0x80 | (code & 0x3F))};
        }
        return true;
    }

    std::string_view text_;
};

}  // namespace

std::optional<Json> read_json(std::string_view text) { return Parser(text).document(); }

std::string json_number(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    std::string text(digits.data(), end);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string json_string(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        std::array<char, 7> code{};
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) >= ' ') {
            out += c;
            continue;
        }
        std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned>(c));
        out += code.data();
    }
    return out += '"';
}

}  // namespace echoloop::http
