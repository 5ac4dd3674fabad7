#include "protocols/imagenex/inspect.h"

#include "protocols/imagenex/codec.h"
#include "protocols/imagenex/framer.h"
#include "protocols/imagenex/layouts.h"
#include "protocols/imagenex/shot_layouts.h"
#include "protocols/inspect_stream.h"

namespace echoloop::imagenex {
namespace {

/// The two bytes of a packed number, shown as the number that they are.
inspect::Field joined(const inspect::Field& low, const inspect::Field& high) {
    Packed14 packed;
    packed.low = static_cast<std::uint8_t>(low.number.value_or(0));
    packed.high = static_cast<std::uint8_t>(high.number.value_or(0));
    inspect::Field out = low;
    out.name.resize(out.name.size() - std::string_view(".low").size());
    out.size = 2;
    const bool position = out.name.ends_with("head_position");
    const auto value = position ? static_cast<std::uint64_t>(position_of(packed)) : std::uint64_t{packed};
    out.number = static_cast<double>(value);
    out.text = std::to_string(value);
    if (position) out.text += is_clockwise(packed) ? " (clockwise)" : " (counter-clockwise)";
    if (!out.name.ends_with("profile_range")) out.unit = "0.3 deg";
    return out;
}

void join_packed(std::vector<inspect::Field>& fields) {
    std::vector<inspect::Field> out;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const bool pair = i + 1 < fields.size() && fields[i].name.ends_with(".low") &&
                          fields[i + 1].name.ends_with(".high");
        out.push_back(pair ? joined(fields[i], fields[i + 1]) : std::move(fields[i]));
        if (pair) ++i;
    }
    fields = std::move(out);
}

inspect::Message inspected_message(const wire::Bytes& bytes, std::size_t offset) {
    inspect::Message out{.offset = offset, .size = bytes.size(), .name = "Frame", .fields = {}, .reason = ""};
    if (const auto message = parse(bytes)) {
        out.name = name_of(*message);
        std::visit([&](const auto& m) { inspect::add_fields(out, m); }, *message);
    } else {
        out.reason = message.error().what();
    }
    join_packed(out.fields);
    return out;
}

/// The fields of the reply within a shot, named after it, in the place of its bytes.
void add_reply(inspect::Message& shot, const wire::Bytes& reply) {
    auto inner = inspected_message(reply, shot.offset + shot_header_bytes);
    if (!inner.reason.empty()) {
        shot.reason = inner.reason;
        return;
    }
    const auto raw = std::find_if(shot.fields.begin(), shot.fields.end(),
                                  [](const inspect::Field& field) { return field.name == "reply"; });
    for (auto& field : inner.fields) field.name.insert(0, "reply.");
    const auto at = shot.fields.erase(raw);
    shot.fields.insert(at, std::make_move_iterator(inner.fields.begin()),
                       std::make_move_iterator(inner.fields.end()));
}

inspect::Message inspected_shot(const FileShot& shot, std::size_t size, std::size_t offset) {
    inspect::Message out{.offset = offset, .size = size, .name = "", .fields = {}, .reason = ""};
    std::visit(
        [&]<class S>(const S& s) {
            out.name = wire::layout<S>.name;
            inspect::add_fields(out, s);
            add_reply(out, s.reply);
        },
        shot);
    return out;
}

inspect::Message inspected(const wire::Bytes& bytes, std::size_t offset, std::size_t size) {
    if (const auto shot = parse_shot(bytes)) return inspected_shot(*shot, size, offset);
    return inspected_message(bytes, offset);
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

bool recognise(wire::ByteView bytes) { return inspect::recognise_stream<Framer>(bytes); }

std::vector<wire::Table> tables() {
    using wire::table_of;
    return {table_of<SwitchCommand>(), table_of<AzimuthCommand>(), table_of<Reply>(),
            table_of<AzimuthReply>(),  table_of<Packed14>(),       table_of<Shot852>(),
            table_of<Shot81A>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    if (const auto shot = parse_shot(bytes)) return encode(*shot);
    const auto message = parse(bytes);
    return message ? encode(*message) : wire::Bytes{};
}

}  // namespace echoloop::imagenex
