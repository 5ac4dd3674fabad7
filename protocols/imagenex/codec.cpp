#include "protocols/imagenex/codec.h"

#include <algorithm>

#include "protocols/imagenex/layouts.h"
#include "protocols/imagenex/shot_layouts.h"
#include "protocols/imagenex/starts_with.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::imagenex {
namespace {

using wire::ByteView;
using wire::Error;
using wire::Reason;

template <class Any, class M>
wire::Result<Any> parse_as(ByteView bytes) {
    auto message = wire::parse<M>(bytes);
    if (!message) return message.error();
    return Any(*std::move(message));
}

wire::Result<Message> parse_reply(ByteView bytes) {
    auto reply = wire::parse<Reply>(bytes);
    if (!reply) return reply.error();
    const bool known = reply->kind == Kind::imx || reply->kind == Kind::igx || reply->kind == Kind::ipx;
    if (!known) return Error{"Reply", "kind", 1, Reason::unknown_message};
    const bool counts_in_14_bits = ((reply->data_bytes.low | reply->data_bytes.high) & 0x80) == 0;
    if (!counts_in_14_bits || !is_legal_data_size(reply->data.size()))
        return Error{"Reply", "data_bytes", 10, Reason::wrong_count};
    return Message(*std::move(reply));
}

wire::Result<Message> parse_pipe_reply(ByteView bytes) {
    auto reply = wire::parse<PipeReply>(bytes);
    if (!reply) return reply.error();
    const bool counts_in_14_bits = ((reply->data_bytes.low | reply->data_bytes.high) & 0x80) == 0;
    if (!counts_in_14_bits ||
        !is_legal_pipe_data_size(static_cast<std::uint8_t>(reply->kind), reply->data.size()))
        return Error{"PipeReply", "data_bytes", 10, Reason::wrong_count};
    return Message(*std::move(reply));
}

constexpr std::size_t base_sizes[] = {128, 256, 384, 640};  // by index
constexpr std::size_t extended_at = 34, extended_unit = 128, pointer_bytes = 2;

bool is_81a(ByteView bytes) { return starts_with(bytes, "81A"); }

/// An .31L shot has one size only.
std::size_t shot_31l_bytes(ByteView bytes) {
    constexpr std::uint8_t index = 2;
    const bool fits = bytes[3] == index &&
                      wire::load<ByteOrder::big, std::uint16_t>(bytes.data() + 4) == Shot31L::bytes &&
                      wire::load<ByteOrder::big, std::uint16_t>(bytes.data() + 6) == Shot31L::reply_bytes;
    return fits ? Shot31L::bytes : 0;
}

/// Bytes that the reply of a shot may have.
std::size_t room(ByteView bytes) {
    return base_sizes[bytes[3]] - shot_header_bytes - (is_81a(bytes) ? pointer_bytes : 0);
}

}  // namespace

bool is_legal_data_size(std::uint64_t bytes) {
    return bytes == 0 || bytes == 128 || bytes == 250 || bytes == 252 || bytes == 500 || bytes == 1000;
}

bool is_legal_pipe_data_size(std::uint8_t kind, std::uint64_t bytes) {
    return bytes == (kind == static_cast<std::uint8_t>(Kind::imx) ? 250U : 0U);
}

wire::Result<SwitchCommand> parse_switch_command(ByteView bytes) { return wire::parse<SwitchCommand>(bytes); }

wire::Result<Message> parse(ByteView bytes) {
    if (bytes.empty()) return Error{"Command", "start", 0, Reason::truncated};
    if (bytes[0] == 'I') {
        const bool azimuth = bytes.size() > 1 && bytes[1] == 'A';
        if (azimuth) return parse_as<Message, AzimuthReply>(bytes);
        const bool pipe = bytes.size() > 3 && is_of_831l(bytes[1], bytes[3]);
        return pipe ? parse_pipe_reply(bytes) : parse_reply(bytes);
    }
    const bool azimuth = bytes.size() > 2 && bytes[2] == azimuth_head_id;
    return azimuth ? parse_as<Message, AzimuthCommand>(bytes) : parse_as<Message, SwitchCommand>(bytes);
}

wire::Bytes encode(const Message& message) {
    return std::visit([](const auto& m) { return wire::serialise(m); }, message);
}

std::optional<std::size_t> shot_bytes(ByteView bytes) {
    constexpr std::string_view names[] = {"852", "81A", "31L"};
    const auto head = std::min<std::size_t>(3, bytes.size());
    const bool ours = std::any_of(std::begin(names), std::end(names), [&](std::string_view name) {
        return starts_with(bytes, name.substr(0, head));
    });
    if (!ours) return 0;
    if (bytes.size() <= extended_at) return std::nullopt;
    if (starts_with(bytes, "31L")) return shot_31l_bytes(bytes);
    if (bytes[3] >= std::size(base_sizes)) return 0;
    const std::size_t extended = is_81a(bytes) ? bytes[extended_at] * extended_unit : 0;
    const std::size_t base = base_sizes[bytes[3]], all = base + extended;
    const auto total = wire::load<ByteOrder::big, std::uint16_t>(bytes.data() + 4);
    const auto reply = wire::load<ByteOrder::big, std::uint16_t>(bytes.data() + 6);
    // Whether the total counts the extended bytes is not said; both are taken.
    const bool fits = (total == all || total == base) && reply <= room(bytes);
    return fits ? all : 0;
}

wire::Result<FileShot> parse_shot(ByteView bytes) {
    const auto size = shot_bytes(bytes);
    if (!size) return Error{"Shot", "extended", bytes.size(), Reason::truncated};
    if (*size == 0) return Error{"Shot", "total_bytes", 4, Reason::wrong_size};
    if (*size > bytes.size()) return Error{"Shot", "fill", bytes.size(), Reason::truncated};
    if (*size < bytes.size()) return Error{"Shot", "fill", *size, Reason::trailing_bytes};
    if (starts_with(bytes, "31L")) return parse_as<FileShot, Shot31L>(bytes);
    return is_81a(bytes) ? parse_as<FileShot, Shot81A>(bytes) : parse_as<FileShot, Shot852>(bytes);
}

wire::Bytes encode(const FileShot& shot) {
    return std::visit([](const auto& s) { return wire::serialise(s); }, shot);
}

std::string name_of(const Message& message) {
    if (const auto* reply = std::get_if<Reply>(&message))
        return std::string("I") + static_cast<char>(reply->kind) + "X";
    if (const auto* reply = std::get_if<PipeReply>(&message))
        return std::string("I") + static_cast<char>(reply->kind) + "X831L";
    constexpr const char* names[] = {"SwitchCommand", "AzimuthCommand", "Reply", "IAX"};
    return names[message.index()];
}

}  // namespace echoloop::imagenex
