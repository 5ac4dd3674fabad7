#include "emulator/scenario/value.h"

#include <algorithm>
#include <utility>

#include "emulator/scenario/number.h"

namespace echoloop::scenario {

const Value* Value::find(std::string_view wanted) const {
    if (!is_map()) return nullptr;
    const auto found = std::ranges::find(items, wanted, &Value::key);
    return found == items.end() ? nullptr : &*found;
}

Value* Value::find(std::string_view wanted) { return const_cast<Value*>(std::as_const(*this).find(wanted)); }

std::string describe(const Value& value) {
    switch (value.kind) {
        case Value::Kind::null:
            return "nothing";
        case Value::Kind::sequence:
            return "a list of " + std::to_string(value.items.size());
        case Value::Kind::map:
            return "a map of keys";
        case Value::Kind::scalar:
            break;
    }
    if (value.quoted) return "text " + in_quotes(value.text);
    if (value.text == "true" || value.text == "false") return "the truth value " + value.text;
    return (parse_number(value.text) ? "the number " : "text ") + in_quotes(value.text);
}

std::string printable(std::string_view text) {
    constexpr std::size_t longest = 60;
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
    std::size_t size = std::min(text.size(), longest);
    while (size > 0 && size < text.size() && continues(text[size])) --size;  // no half UTF-8 character
    std::string shown;
    for (const char c : text.substr(0, size))
        shown += static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
    return shown + (text.size() > size ? "..." : "");
}

std::string in_quotes(std::string_view text) { return "'" + printable(text) + "'"; }

}  // namespace echoloop::scenario
