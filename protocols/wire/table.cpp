#include "protocols/wire/table.h"

#include <array>
#include <cstdio>

namespace echoloop::wire {

namespace {

std::string joined(const std::vector<std::string>& names) {
    std::string out;
    for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
    return out;
}

std::string count_text(const CountRef& count) {
    std::string out(count.key);
    if (!count.times.empty()) out.append(" * ").append(count.times);
    if (count.per > 1) out = "ceil(" + out + " / " + std::to_string(count.per) + ')';
    return out;
}

std::string type_text(const Row& row) {
    switch (row.kind) {
        case Kind::counted:
            return row.type + '[' + count_text(row.count) + ']';
        case Kind::rest:
            return "u8[rest]";
        case Kind::list:
            return row.type + "[rest]";
        case Kind::section:
            return joined(row.tables) + (row.optional ? ", optional" : "");
        case Kind::tagged_list:
            return "sections";
        default:
            return row.elements > 1 ? row.type + '[' + std::to_string(row.elements) + ']' : row.type;
    }
}

std::string meaning(const Row& row) {
    std::string out(row.meta.help);
    if (row.kind == Kind::magic) out.append(" \"").append(row.characters).append("\"");
    for (const NamedValue& known :
         row.kind == Kind::constant ? std::span<const NamedValue>{} : row.meta.names) {
        std::array<char, 24> number{};
        const char* format = row.meta.format == Format::bits ? "0x%llx " : "%llu ";
        std::snprintf(number.data(), number.size(), format, static_cast<unsigned long long>(known.value));
        out.append(out.empty() ? "" : "; ").append(number.data()).append(known.name);
    }
    return out;
}

std::string cells(std::initializer_list<std::string> values) {
    std::string out = "|";
    for (const std::string& value : values) out += ' ' + value + " |";
    return out + '\n';
}

}  // namespace

std::string markdown(const Table& table) {
    std::string out = "### " + table.name + "\n\n" + table.help;
    if (!table.tag.empty()) out += " (section `" + table.tag + "`)";
    out += ".\n\n";
    if (table.rows.empty()) return out + "No payload.\n";
    out += cells({"offset", "type", "field", "unit", "meaning"}) + "|---|---|---|---|---|\n";
    for (const Row& row : table.rows) {
        out += cells({row.offset ? std::to_string(*row.offset) : "", type_text(row),
                      '`' + std::string(row.meta.name) + '`', std::string(row.meta.unit), meaning(row)});
    }
    return out;
}

}  // namespace echoloop::wire
