// Messages that nobody recorded, made from the field tables of a family: constants and names as the tables
// have them, numbers at the edges of what they can say, arrays as long as their counts. Where a message says
// how long it is, and what it sums up to, is put right by `repair`.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "protocols/inspect.h"
#include "protocols/nmea/sentences.h"
#include "protocols/nortek/codec.h"
#include "protocols/ping/codec.h"
#include "protocols/reson7k/codec.h"
#include "protocols/teledyne/codec.h"
#include "protocols/waterlinked/pd4.h"
#include "protocols/waterlinked/sentence.h"
#include "protocols/wayfinder/codec.h"
#include "protocols/wire/crc.h"

namespace echoloop::fuzz {

/// SplitMix64 (Steele, Lea, Flood 2014): as good for any seed, and there is a new one for every input.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint32_t operator()() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15;
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9;
        z = (z ^ z >> 27) * 0x94D049BB133111EB;
        return static_cast<std::uint32_t>((z ^ z >> 31) >> 32);
    }

  private:
    std::uint64_t state_;
};

using wire::ByteOrder;
using wire::Bytes;
using wire::ByteView;

inline std::size_t below(Random& random, std::size_t end) { return end == 0 ? 0 : random() % end; }

/// `value` in `size` bytes, 8 at most.
inline void put(std::uint8_t* at, std::size_t size, ByteOrder order, std::uint64_t value) {
    for (std::size_t i = 0; i < size; ++i)
        at[order == ByteOrder::little ? i : size - 1 - i] = static_cast<std::uint8_t>(value >> 8 * i);
}
inline std::uint64_t get(const std::uint8_t* at, std::size_t size, ByteOrder order) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
        value = value << 8 | at[order == ByteOrder::big ? i : size - 1 - i];
    return value;
}

/// Where a message of a family says how long it is: its bytes, but for `less`. Counted from its end if
/// negative.
struct Length {
    std::string_view family;
    std::ptrdiff_t at;
    std::size_t bytes, less = 0;
    ByteOrder order = ByteOrder::little;
    bool digits = false;  ///< upper-case hexadecimal
};
inline constexpr Length lengths[] = {{"ping", 2, 2, 10},
                                     {"teledyne", 2, 2, 2},
                                     {"wayfinder", 3, 2},
                                     {"wayfinder", 7, 2, 7},
                                     {"nortek", 4, 2, 10},
                                     {"cerulean", 2, 2, 10},
                                     {"norbit", 8, 4},
                                     {"oculus", 10, 4, 16},
                                     {"kmall", 0, 4},
                                     {"kmall", -4, 4},
                                     {"sonar3d", 4, 4},
                                     {"r2sonic", 4, 4, 0, ByteOrder::big},
                                     {"reson7k", 12, 4},
                                     {"reson7k", 16, 4, 36},
                                     {"reson7k", 44, 4, 36},
                                     {"reson7k", 8, 4},
                                     {"seanet", 5, 2, 6},
                                     {"seanet", 9, 1, 11},
                                     {"seanet", 1, 4, 6, ByteOrder::big, true},
                                     {"aris", 0, 4, 4},
                                     {"deltat", 4, 2, 0, ByteOrder::big}};

inline std::uint8_t* place_of(const Length& length, Bytes& message) {
    const auto size = static_cast<std::ptrdiff_t>(message.size());
    const std::ptrdiff_t at = length.at < 0 ? size + length.at : length.at;
    const bool fits = at >= 0 && at + static_cast<std::ptrdiff_t>(length.bytes) <= size;
    return fits ? message.data() + at : nullptr;
}

inline bool is_right(const Length& length, ByteView message) {
    Bytes copy(message.begin(), message.end());
    const std::uint8_t* at = place_of(length, copy);
    if (at == nullptr || copy.size() < length.less) return false;
    if (!length.digits) return get(at, length.bytes, length.order) == copy.size() - length.less;
    char text[8];
    std::snprintf(text, sizeof text, "%04X", static_cast<unsigned>(copy.size() - length.less) & 0xFFFF);
    return std::equal(at, at + 4, text);
}

inline void set(const Length& length, Bytes& message) {
    std::uint8_t* at = place_of(length, message);
    if (at == nullptr || message.size() < length.less) return;
    const std::size_t size = message.size() - length.less;
    if (!length.digits) return put(at, length.bytes, length.order, size);
    char text[8];
    std::snprintf(text, sizeof text, "%04X", static_cast<unsigned>(size) & 0xFFFF);
    std::copy_n(text, 4, at);
}

/// The checksum of a whole message.
inline void set_checksum(std::string_view family, Bytes& message) {
    const std::size_t size = message.size();
    if ((family == "ping" || family == "cerulean") && size >= 10) {
        put(message.data() + size - 2, 2, ByteOrder::little, ping::checksum(message));
    } else if (family == "sonar3d" && size >= 12) {
        put(message.data() + size - 4, 4, ByteOrder::little, wire::crc32(ByteView(message).first(size - 4)));
    } else if (family == "norbit" && size >= 24 && message[4] <= 2) {
        put(message.data() + 20, 4, ByteOrder::little, wire::crc32(ByteView(message).subspan(24)));
    } else if (family == "reson7k" && size >= 36 + 64 + 4 &&
               get(message.data() + 2, 2, ByteOrder::little) == 36) {
        Bytes record(message.begin() + 36, message.end());
        reson7k::seal(record);
        std::ranges::copy(record, message.begin() + 36);
    } else if (family == "nortek" && size >= nortek::header_size && message[0] == 0xA5) {
        put(message.data() + 6, 2, ByteOrder::little,
            nortek::checksum(ByteView(message).subspan(nortek::header_size)));
        put(message.data() + 8, 2, ByteOrder::little, nortek::checksum(ByteView(message).first(8)));
    } else if (family == "wayfinder" && size > 11) {
        message[0] = 0xAA, message[1] = 0x10, message[2] = 0x01, message[5] = 0x02;
        if (message[6] == 5 && size > 13)
            put(message.data() + size - 4, 2, ByteOrder::little,
                wayfinder::sum(ByteView(message).subspan(9, size - 13)));
        put(message.data() + size - 2, 2, ByteOrder::little,
            wayfinder::sum(ByteView(message).first(size - 2)));
    } else if (family == "teledyne" && size > 2 && (message[0] == 0x7D || message[0] == 0x7F)) {
        put(message.data() + size - 2, 2, ByteOrder::little,
            teledyne::sum(ByteView(message).first(size - 2)));
    } else if (family == "waterlinked" && !message.empty() && message[0] == '}' && size > 2) {
        put(message.data() + size - 2, 2, ByteOrder::little, waterlinked::pd4_sum(message));
    } else if (family == "waterlinked" && !message.empty() && message[0] == 'w') {
        const auto star = std::ranges::find(message, '*');
        if (message.end() - star < 3) return;
        char text[4];
        std::snprintf(text, sizeof text, "%02x", waterlinked::crc8(std::string(message.begin(), star)));
        std::copy_n(text, 2, star + 1);
    } else if (family == "nmea") {
        const auto star = std::ranges::find(message, '*');
        if (star == message.begin() || message.end() - star < 3) return;
        const std::string body(message.begin() + 1, star);
        char text[4];
        std::snprintf(text, sizeof text, "%02X", nmea::checksum(body));
        std::copy_n(text, 2, star + 1);
    }
}

/// A number as devices do not expect it.
inline std::uint64_t edge(Random& random, std::size_t size) {
    constexpr std::uint32_t floats[] = {0x7FC00000, 0x7F800000, 0xFF800000, 0x80000000,
                                        0x7149F2CA, 1,          0xBF800000};
    const std::uint64_t all = size >= 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << 8 * size) - 1;
    switch (random() % 9) {
        case 0:
            return 0;
        case 1:
            return 1;
        case 2:
            return all;
        case 3:
            return all >> 1;
        case 4:
            return (all >> 1) + 1;
        case 5:
            return all - 1;
        case 6:
            return random() % 300;
        case 7:
            return size == 4   ? floats[random() % std::size(floats)]
                   : size == 8 ? std::uint64_t{floats[random() % 3]} << 32 | std::uint64_t{0xF0000} << 32
                               : random();
        default:
            return (std::uint64_t{random()} << 31 | random()) & all;
    }
}

inline constexpr std::size_t wayfinder_header = 9;  // bytes

/// One message of a table, or a part of one.
class MadeMessage {
  public:
    MadeMessage(const inspect::Family& family, Random& random)
        : family_(family), tables_(tables_of(family)), random_(random) {}

    const std::vector<wire::Table>& tables() const { return tables_; }

    /// Behind what the tables of the family have before it, with lengths and checksum.
    Bytes of(const wire::Table& table) {
        const bool part = family_.name == "wayfinder" && table.base == 0 && table.name != "Header";
        Bytes message(part ? wayfinder_header : table.base, 0);  // a part stands where its message would
        if (family_.name == "cerulean" && message.size() >= 2) message[0] = 'B', message[1] = 'R';  // of ping
        for (const auto& head : tables_)
            if (!message.empty() && &head != &table) put_head(head, table, message);
        counts_.clear();
        append(table, message, 0);
        const bool ping = family_.name == "ping" || family_.name == "cerulean";
        if (ping) message.resize(message.size() + 2);
        if (family_.name == "wayfinder") message.resize(message.size() + 2);
        if (family_.name == "seanet") message.push_back('\n');
        for (const Length& length : lengths)
            if (length.family == family_.name) set(length, message);
        set_checksum(family_.name, message);
        return message;
    }
    /// Any of them.
    Bytes any() { return of(tables_[below(random_, tables_.size())]); }

  private:
    /// Made once: this is called for every input.
    static const std::vector<wire::Table>& tables_of(const inspect::Family& family) {
        static std::map<std::string_view, std::vector<wire::Table>> made;
        const auto found = made.find(family.name);
        return found != made.end() ? found->second : made.emplace(family.name, family.tables()).first->second;
    }
    const wire::Table* find(const std::string& name) const {
        const auto found = std::ranges::find(tables_, name, &wire::Table::name);
        return found == tables_.end() ? nullptr : &*found;
    }
    static std::size_t element_size(const std::string& type) {
        if (type.starts_with("char[")) return std::strtoul(type.c_str() + 5, nullptr, 10);
        if (type == "hex[4]") return 4;
        const bool number = type.size() >= 2 && type.size() <= 3 &&
                            std::string_view("uif").find(type[0]) != std::string_view::npos;
        return number ? std::strtoul(type.c_str() + 1, nullptr, 10) / 8 : 0;
    }

    /// What stands before all messages, and the number by which the message is known.
    void put_head(const wire::Table& head, const wire::Table& table, Bytes& message) {
        for (const wire::Row& row : head.rows) {
            const std::size_t size = element_size(row.type);
            if (!row.offset || *row.offset + size > message.size()) continue;
            std::uint8_t* at = message.data() + *row.offset;
            if (row.kind == wire::Kind::magic) std::ranges::copy(row.characters, at);
            if (row.kind == wire::Kind::constant) put(at, size, head.order, row.constant);
            if (row.kind != wire::Kind::value || row.meta.names.empty()) continue;
            const auto name = std::ranges::find(row.meta.names, table.name, &wire::NamedValue::name);
            if (name != row.meta.names.end()) put(at, size, head.order, name->value);
        }
    }

    std::size_t counted(const wire::CountRef& ref) {
        std::size_t count = counts_[std::string(ref.key)];
        if (!ref.times.empty()) count *= counts_[std::string(ref.times)];
        return (count + ref.per - 1) / ref.per;
    }

    void append_number(Bytes& out, std::size_t size, ByteOrder order, std::uint64_t value) {
        out.resize(out.size() + size);
        if (size <= 8) put(out.data() + out.size() - size, size, order, value);
    }
    void append_elements(const wire::Row& row, std::size_t count, ByteOrder order, Bytes& out, int depth) {
        const wire::Table* part =
            row.tables.empty() ? nullptr : find(row.tables[below(random_, row.tables.size())]);
        for (std::size_t i = 0; i < std::min<std::size_t>(count, 1000); ++i) {
            if (part != nullptr) {
                append(*part, out, depth + 1);
                continue;
            }
            const std::size_t size = element_size(row.type);
            std::uint64_t value = random_() % 3 == 0 ? edge(random_, size) : 0;
            if (!row.meta.names.empty() && random_() % 4 != 0)
                value = row.meta.names[below(random_, row.meta.names.size())].value;
            append_number(out, size, order, value);
        }
    }
    void append_section(const wire::Row& row, Bytes& out, int depth) {
        const wire::Table* part =
            row.tables.empty() ? nullptr : find(row.tables[below(random_, row.tables.size())]);
        if (part == nullptr || (row.optional && random_() % 2 == 0)) return;
        const std::size_t start = out.size();
        out.insert(out.end(), part->tag.begin(), part->tag.end());
        const bool sized = row.kind == wire::Kind::section;
        if (sized) out.resize(out.size() + 2);
        append(*part, out, depth + 1);
        out.resize((out.size() + 3) / 4 * 4);
        if (sized) put(out.data() + start + 2, 2, ByteOrder::big, out.size() - start);
    }
    void append(const wire::Table& table, Bytes& out, int depth) {
        if (depth > 6 || out.size() > 20000) return;
        for (const wire::Row& row : table.rows) append(row, table.order, out, depth);
    }
    void append(const wire::Row& row, ByteOrder order, Bytes& out, int depth) {
        using wire::Kind;
        switch (row.kind) {
            case Kind::value:
            case Kind::group:
                return append_elements(row, row.elements, order, out, depth);
            case Kind::count: {
                const std::size_t count = random_() % 8 == 0 ? random_() % 300 : random_() % 4;
                counts_[std::string(row.key)] = count;
                return append_number(out, element_size(row.type), order,
                                     count + static_cast<std::uint64_t>(row.bias));
            }
            case Kind::counted:
                return append_elements(row, counted(row.count), order, out, depth);
            case Kind::constant:
                return append_number(out, element_size(row.type), order, row.constant);
            case Kind::magic:
                out.insert(out.end(), row.characters.begin(), row.characters.end());
                return;
            case Kind::total_size:
                return append_number(out, element_size(row.type), order, 0);
            case Kind::rest:
                return append_elements(row, random_() % 20, order, out, depth);
            case Kind::section:
                return append_section(row, out, depth);
            case Kind::list:
                return append_elements(row, random_() % 4, order, out, depth);
            case Kind::tagged_list:
                for (std::size_t i = random_() % 4; i > 0; --i) append_section(row, out, depth);
        }
    }

    const inspect::Family& family_;
    const std::vector<wire::Table>& tables_;
    Random& random_;
    std::map<std::string, std::size_t> counts_;
};

}  // namespace echoloop::fuzz
