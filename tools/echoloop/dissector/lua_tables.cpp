#include "tools/echoloop/dissector/lua_tables.h"

#include <cstdio>

namespace echoloop::cli {
namespace {

using wire::Format;
using wire::Kind;
using wire::Row;

const char* name_of(Kind kind) {
    switch (kind) {
        case Kind::value:
            return "value";
        case Kind::group:
            return "group";
        case Kind::count:
            return "count";
        case Kind::counted:
            return "counted";
        case Kind::constant:
            return "constant";
        case Kind::magic:
            return "magic";
        case Kind::total_size:
            return "total_size";
        case Kind::rest:
            return "rest";
        case Kind::section:
            return "section";
        case Kind::list:
            return "list";
        case Kind::tagged_list:
            return "tagged_list";
    }
    return "";
}

const char* name_of(Format format) {
    switch (format) {
        case Format::hex:
            return "hex";
        case Format::bits:
            return "bits";
        case Format::ipv4:
            return "ipv4";
        case Format::plain:
            break;
    }
    return "";
}

/// Collects `key=value` pairs; values that are empty are left out.
class Pairs {
  public:
    void text(const char* key, std::string_view value) {
        if (!value.empty()) put(key, lua_text(value));
    }
    void number(const char* key, std::int64_t value, std::int64_t usual = 0) {
        if (value != usual) put(key, std::to_string(value));
    }
    void put(const char* key, const std::string& value) {
        body_.append(body_.empty() ? "" : ",").append(key).append("=").append(value);
    }
    std::string table() const { return '{' + body_ + '}'; }

  private:
    std::string body_;
};

std::string lua_names(std::span<const wire::NamedValue> names) {
    std::string out;
    for (const wire::NamedValue& one : names)
        out += (out.empty() ? "{" : ",{") + std::to_string(one.value) + ',' + lua_text(one.name) + '}';
    return '{' + out + '}';
}

std::string lua_list(const std::vector<std::string>& names) {
    std::string out = "{";
    for (const std::string& name : names) out.append(out.size() > 1 ? "," : "").append(lua_text(name));
    return out.append("}");
}

std::string lua_row(const Row& row) {
    Pairs pairs;
    pairs.text("kind", name_of(row.kind));
    pairs.text("name", row.meta.name);
    pairs.text("type", row.type);
    pairs.text("unit", row.meta.unit);
    pairs.text("help", row.meta.help);
    pairs.text("format", name_of(row.meta.format));
    if (row.offset) pairs.number("offset", static_cast<std::int64_t>(*row.offset), -1);
    pairs.number("elements", static_cast<std::int64_t>(row.elements), 1);
    pairs.text("key", row.key);
    pairs.number("bias", row.bias);
    pairs.text("count", row.count.key);
    pairs.text("times", row.count.times);
    pairs.number("per", row.count.per, 1);
    pairs.text("characters", row.characters);
    if (row.kind == Kind::constant) pairs.number("constant", static_cast<std::int64_t>(row.constant), -1);
    if (!row.meta.names.empty()) pairs.put("names", lua_names(row.meta.names));
    if (!row.tables.empty()) pairs.put("tables", lua_list(row.tables));
    return pairs.table();
}

}  // namespace

std::string lua_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += {'\\', c};
        } else if (byte < 0x20 || byte == 0x7F) {
            char escaped[8];
            std::snprintf(escaped, sizeof escaped, "\\%03d", byte);
            out += escaped;
        } else {
            out += c;
        }
    }
    return out + '"';
}

std::string lua_places(const inspect::Places& places) {
    Pairs pairs;
    pairs.text("tcp", places.tcp);
    pairs.text("udp", places.udp);
    if (places.serial) pairs.put("serial", "true");
    return pairs.table();
}

std::string lua_tables(const inspect::Family& family) {
    std::string out = "{\n";
    for (const wire::Table& table : family.tables()) {
        Pairs head;
        head.text("name", table.name);
        head.text("tag", table.tag);
        head.text("help", table.help);
        if (table.order == wire::ByteOrder::big) head.put("big", "true");
        std::string rows;
        for (const Row& row : table.rows) rows += "    " + lua_row(row) + ",\n";
        head.put("rows", "{\n" + rows + "  }");
        out += "  [" + lua_text(table.name) + "]=" + head.table() + ",\n";
    }
    return out + '}';
}

}  // namespace echoloop::cli
