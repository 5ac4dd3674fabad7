#include "protocols/sonar3d/inspect.h"

#include "protocols/inspect_stream.h"
#include "protocols/sonar3d/framer.h"
#include "protocols/sonar3d/layouts.h"

namespace echoloop::sonar3d {
namespace {

template <class T>
concept Nested = requires {
    Fields<T>::rows;
};

template <class T>
wire::Value value_of(const T& value) {
    if constexpr (std::is_same_v<T, float>)
        return wire::readable(value);
    else if constexpr (std::is_signed_v<T>)
        return std::int64_t{value};
    else if constexpr (std::is_integral_v<T>)
        return std::uint64_t{value};
    else if constexpr (std::is_same_v<T, std::string>)
        return value;
    else
        return std::vector<double>(value.begin(), value.end());
}

/// Places in a compressed message mean nothing: all fields have those of the payload.
void add_field(inspect::Message& out, const std::string& name, std::string_view unit, wire::Value value) {
    wire::FieldView view;
    view.name = name;
    view.unit = unit;
    view.offset = 8;
    view.size = out.size - frame_bytes;
    view.value = std::move(value);
    out.fields.push_back(inspect::to_field(view, out.offset));
}

template <class M>
void add_fields(inspect::Message& out, const std::string& prefix, const M& message) {
    const auto add = [&](const auto& row) {
        const auto& value = message.*row.member;
        const std::string name = prefix + std::string(row.name);
        if constexpr (Nested<std::remove_cvref_t<decltype(value)>>)
            add_fields(out, name + '.', value);
        else
            add_field(out, name, row.unit, value_of(value));
    };
    std::apply([&](const auto&... row) { (add(row), ...); }, Fields<M>::rows);
}

inspect::Message inspected(const wire::Bytes& bytes, std::size_t offset) {
    inspect::Message out{.offset = offset, .size = bytes.size(), .name = "Packet"};
    const auto packet = parse(bytes);
    if (!packet) {
        out.reason = packet.error().what();
        return out;
    }
    const std::string& url = packet->type_url;
    out.name = url.substr(url.find_last_of("./") + 1);
    add_field(out, "id", "", std::string(packet->version == Version::rip1 ? "RIP1" : "RIP2"));
    add_field(out, "type_url", "", url);
    std::visit(
        [&]<class M>(const M& message) {
            if constexpr (std::is_same_v<M, OtherMessage>)
                add_field(out, "value", "", value_of(message.value));
            else
                add_fields(out, "", message);
        },
        packet->message);
    return out;
}

template <class T>
std::string type_name() {
    if constexpr (Nested<T>)
        return std::string(Fields<T>::name);
    else if constexpr (std::is_same_v<T, std::vector<std::uint32_t>>)
        return "packed varint";
    else if constexpr (std::is_integral_v<T>)
        return "varint";
    else if constexpr (std::is_same_v<T, float>)
        return "f32";
    else
        return std::is_same_v<T, std::string> ? "string" : "bytes";
}

template <class M>
wire::Table table_of() {
    wire::Table table{.name = std::string(Fields<M>::name), .help = std::string(Fields<M>::help)};
    table.help += ". Protobuf: the first column is the number of the field, and fields that are 0 are absent";
    const auto add = [&]<class T>(const Field<M, T>& row) {
        table.rows.push_back({.meta = {row.name, row.unit, row.help}, .type = type_name<T>()});
        table.rows.back().offset = row.number;
    };
    std::apply([&](const auto&... row) { (add(row), ...); }, Fields<M>::rows);
    return table;
}

wire::Table frame_table() {
    const auto row = [](std::optional<std::size_t> offset, std::string_view name, const char* type,
                        std::string_view unit, std::string_view help) {
        return wire::Row{.meta = {name, unit, help}, .type = type, .offset = offset};
    };
    return {.name = "Frame",
            .help = "around each message, little-endian",
            .rows = {row(0, "id", "char[4]", "", "RIP2, or RIP1 of older firmware"),
                     row(4, "length", "u32", "B", "of everything, id, this field and checksum too"),
                     row(8, "payload", "u8[]", "", "a Packet; in RIP2 one Snappy block of it"),
                     row(std::nullopt, "checksum", "u32", "", "CRC-32 (IEEE 802.3) of all bytes before it")}};
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

bool recognise(wire::ByteView bytes) { return inspect::recognise_stream<Framer>(bytes); }

std::vector<wire::Table> tables() {
    return {frame_table(),      table_of<Envelope>(),   table_of<Any>(),        table_of<Timestamp>(),
            table_of<Header>(), table_of<RangeImage>(), table_of<BitmapImage>()};
}

}  // namespace echoloop::sonar3d
