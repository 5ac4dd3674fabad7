#include "protocols/aris/inspect.h"

#include "protocols/aris/framer.h"
#include "protocols/aris/layouts.h"
#include "protocols/aris/protobuf.h"
#include "protocols/inspect_stream.h"

namespace echoloop::aris {
namespace {

using protobuf::is_names;
using protobuf::is_part;

template <class T>
wire::Value value_of(const T& value) {
    if constexpr (std::is_same_v<T, float>) {
        return wire::readable(value);
    } else if constexpr (std::is_integral_v<T>) {
        return std::uint64_t{value};
    } else if constexpr (is_names<T>) {
        std::string all;
        for (const std::string& name : value) all += (all.empty() ? "" : " ") + name;
        return all;
    } else if constexpr (std::is_same_v<T, std::string>) {
        return value;
    } else {
        return std::vector<double>(value.begin(), value.end());
    }
}

/// Fields have the place of their message: in protobuf they have no fixed one.
template <class M>
void add_fields(inspect::Message& out, const std::string& prefix, const M& message) {
    const auto add = [&]<class T>(const Field<M, T>& row) {
        const T& value = message.*row.member;
        const std::string name = prefix + std::string(row.name);
        if constexpr (is_part<T>) {
            if (value) add_fields(out, name + '.', *value);
        } else {
            wire::FieldView view;
            view.name = name;
            view.unit = row.unit;
            view.size = out.size;
            view.value = value_of(value);
            out.fields.push_back(inspect::to_field(view, out.offset));
        }
    };
    std::apply([&](const auto&... row) { (add(row), ...); }, Fields<M>::rows);
}

template <class M>
inspect::Message inspected(const M& message, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size, .name = std::string(Fields<M>::name)};
    add_fields(out, "", message);
    return out;
}

inspect::Message inspected_part(const FramePart& part, std::size_t size) {
    inspect::Message out = inspected(part, 0, size);
    if (part.header.empty()) return out;
    const auto header = parse_frame_header(part.header);
    if (!header) {
        out.reason = "the frame header is too short";
        return out;
    }
    wire::visit_fields(*header, [&](const wire::FieldView& view) {
        out.fields.push_back(inspect::to_field(view, 0));
        out.fields.back().name = "header." + view.name;
    });
    return out;
}

/// Protobuf has no mark of its own: a beacon says who it is and fits its version, and has nothing else.
std::optional<Availability> sure_beacon(wire::ByteView bytes) {
    auto beacon = parse_availability(bytes);
    const bool sure = beacon && beacon->serial != 0 && beacon->version &&
                      beacon->system_type <= system_type::aris1200 &&
                      beacon->state <= connection_state::busy && encode(*beacon).size() == bytes.size();
    return sure ? beacon : std::nullopt;
}

/// Of the first part the header is the sign; of others that the samples lie within the frame.
std::optional<FramePart> sure_part(wire::ByteView bytes) {
    auto part = parse_frame_part(bytes);
    if (!part || part->frame_index == 0 || part->data.empty()) return std::nullopt;
    const bool fits = part->data_offset <= part->total_data_size &&
                      part->data.size() <= part->total_data_size - part->data_offset;
    const auto header = parse_frame_header(part->header);
    const bool first = part->data_offset == 0;
    const bool sure = first ? header && header->version == header_version : part->header.empty();
    return fits && sure ? part : std::nullopt;
}

template <class T>
std::string type_name() {
    if constexpr (is_part<T>)
        return std::string(Fields<typename T::value_type>::name);
    else if constexpr (is_names<T>)
        return "strings";
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
    table.help += ". Protobuf: the first column is the number of the field; fields that are 0 are absent";
    const auto add = [&]<class T>(const Field<M, T>& row) {
        table.rows.push_back({.meta = {row.name, row.unit, row.help}, .type = type_name<T>()});
        table.rows.back().offset = row.number;
    };
    std::apply([&](const auto&... row) { (add(row), ...); }, Fields<M>::rows);
    return table;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    if (const auto beacon = sure_beacon(bytes)) return {inspected(*beacon, 0, bytes.size())};
    if (const auto part = sure_part(bytes)) return {inspected_part(*part, bytes.size())};
    return inspect::decode_stream<Framer>(
        bytes, [](const Frame& frame, std::size_t at) { return inspected(frame.command, at, frame.size); });
}

/// A stream is one if it begins with a command.
bool recognise(wire::ByteView bytes) {
    if (sure_beacon(bytes) || sure_part(bytes)) return true;
    Framer framer;
    framer.feed(bytes.first(std::min(bytes.size(), length_bytes + longest_command)));
    return framer.next() && framer.frame_offset() == 0;
}

std::vector<wire::Table> tables() {
    return {table_of<Availability>(),     table_of<SoftwareVersion>(), table_of<Names>(),
            table_of<Command>(),          table_of<SetDateTime>(),     table_of<SetReceiver>(),
            table_of<SetStream>(),        table_of<PacketDelay>(),     table_of<SetAcoustics>(),
            table_of<SetSalinity>(),      table_of<SetTelephoto>(),    table_of<SetFocus>(),
            table_of<ForceFocus>(),       table_of<SetMount>(),        table_of<AxisValue>(),
            table_of<SetSyslog>(),        table_of<FramePart>(),       table_of<FramePartAck>(),
            wire::table_of<FrameHeader>()};
}

}  // namespace echoloop::aris
