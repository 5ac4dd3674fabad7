#include "protocols/imagenex/inspect.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "protocols/imagenex/codec.h"
#include "protocols/imagenex/framer.h"
#include "protocols/imagenex/layouts.h"
#include "protocols/imagenex/shot_layouts.h"
#include "protocols/inspect_stream.h"

namespace echoloop::imagenex {
namespace {

/// The two bytes of what an 831L's inclinometer says; nothing if `name` is none of these.
std::optional<inspect::Field> joined_signed(const inspect::Field& low, const inspect::Field& high) {
    constexpr std::pair<std::string_view, std::string_view> units[] = {{"roll", "0.025 deg"},
                                                                       {"pitch", "0.025 deg"},
                                                                       {"roll_acceleration", "0.24414 mg"},
                                                                       {"pitch_acceleration", "0.24414 mg"}};
    inspect::Field out = low;
    out.name.resize(out.name.size() - std::string_view(".low").size());
    const auto last = std::string_view(out.name).substr(out.name.find_last_of('.') + 1);
    const auto* unit = std::ranges::find(units, last, &std::pair<std::string_view, std::string_view>::first);
    if (unit == std::end(units)) return std::nullopt;
    Signed14 both;
    both.low = static_cast<std::uint8_t>(low.number.value_or(0));
    both.high = static_cast<std::uint8_t>(high.number.value_or(0));
    out.size = 2;
    out.unit = unit->second;
    out.number = both.value();
    out.text = std::to_string(both.value());
    if ((both.high & Signed14::is_new) != 0) out.text += " (new)";
    if ((both.high & Signed14::alarm) != 0) out.text += " (alarm)";
    return out;
}

/// The two bytes of a packed number, shown as the number that they are.
inspect::Field joined(const inspect::Field& low, const inspect::Field& high) {
    if (auto number = joined_signed(low, high)) return *std::move(number);
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
void add_reply(inspect::Message& shot, const wire::Bytes& reply, std::size_t reply_at) {
    auto inner = inspected_message(reply, shot.offset + reply_at);
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
            if constexpr (std::is_same_v<S, Shot31L>)
                add_reply(out, s.reply, S::reply_at);
            else
                add_reply(out, s.reply, shot_header_bytes);
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
            table_of<PipeReply>(),     table_of<AzimuthReply>(),   table_of<Packed14>(),
            table_of<Signed14>(),      table_of<Shot852>(),        table_of<Shot81A>(),
            table_of<Shot31L>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    if (const auto shot = parse_shot(bytes)) return encode(*shot);
    const auto message = parse(bytes);
    return message ? encode(*message) : wire::Bytes{};
}

}  // namespace echoloop::imagenex
