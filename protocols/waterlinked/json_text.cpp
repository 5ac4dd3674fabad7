#include "protocols/waterlinked/json_text.h"

#include <algorithm>

namespace echoloop::waterlinked {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Bytes of the string that `text` begins with, quotes included; 0: it is not whole.
std::size_t string_size(std::string_view text) {
    for (std::size_t at = 1; at < text.size(); ++at) {
        if (text[at] == '\\')
            ++at;
        else if (text[at] == '"')
            return at + 1;
    }
    return 0;
}

/// Bytes of a number or a word.
std::size_t token_size(std::string_view text) {
    const auto in_token = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' ||
               c == '-' || c == '.';
    };
    return static_cast<std::size_t>(std::ranges::find_if_not(text, in_token) - text.begin());
}

std::size_t value_size(std::string_view text) {
    if (text.empty()) return 0;
    if (text[0] == '"') return string_size(text);
    return text[0] == '{' || text[0] == '[' ? json_size(text) : token_size(text);
}

/// Walks through an object's text.
class Walk {
  public:
    explicit Walk(std::string_view text) : rest_(text) {}
    bool take(char c) {
        skip_space();
        if (!rest_.starts_with(c)) return false;
        rest_.remove_prefix(1);
        return true;
    }
    /// "" if there is none.
    std::string_view take_value() {
        skip_space();
        const std::string_view value = rest_.substr(0, value_size(rest_));
        rest_.remove_prefix(value.size());
        return value;
    }
    bool at_end() {
        skip_space();
        return rest_.empty();
    }

  private:
    void skip_space() {
        while (!rest_.empty() && is_space(rest_[0])) rest_.remove_prefix(1);
    }
    std::string_view rest_;
};

}  // namespace

std::size_t json_size(std::string_view text) {
    std::size_t depth = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '"') {
            const std::size_t size = string_size(text.substr(at));
            if (size == 0) return 0;
            at += size - 1;
        } else if (c == '{' || c == '[') {
            ++depth;
        } else if ((c == '}' || c == ']') && (depth == 0 || --depth == 0)) {
            return at + 1;
        }
    }
    return 0;
}

std::optional<std::vector<Member>> members_of(std::string_view text) {
    Walk walk(text);
    std::vector<Member> members;
    if (!walk.take('{')) return std::nullopt;
    if (walk.take('}')) return walk.at_end() ? std::optional(members) : std::nullopt;
    do {
        const std::string_view key = walk.take_value();
        if (!key.starts_with('"') || !walk.take(':')) return std::nullopt;
        const std::string_view value = walk.take_value();
        if (value.empty()) return std::nullopt;
        members.push_back({unquoted(key), value});
    } while (walk.take(','));
    if (!walk.take('}') || !walk.at_end()) return std::nullopt;
    return members;
}

std::string_view value_of(const std::vector<Member>& members, std::string_view key) {
    const auto found = std::ranges::find(members, key, &Member::key);
    return found == members.end() ? std::string_view() : found->value;
}

std::string_view unquoted(std::string_view value) {
    const bool quoted = value.size() >= 2 && value.front() == '"' && value.back() == '"';
    return quoted ? value.substr(1, value.size() - 2) : value;
}

}  // namespace echoloop::waterlinked
