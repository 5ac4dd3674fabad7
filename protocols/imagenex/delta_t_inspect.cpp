#include "protocols/imagenex/delta_t_inspect.h"

#include <optional>

#include "protocols/imagenex/delta_t_codec.h"
#include "protocols/imagenex/delta_t_layouts.h"
#include "protocols/inspect_stream.h"

namespace echoloop::imagenex {
namespace {

constexpr std::uint8_t first_range = 2, last_range = 14;

bool is_plain(const Profile83P&) { return true; }
/// Two letters are no sure sign: what follows must be codes that there are.
bool is_plain(const ExternalControl& c) {
    return c.id == 0 && c.range >= first_range && c.range <= last_range && c.sector <= 3 && c.beams <= 2;
}

/// The message at the start of the bytes, if there is one.
std::optional<inspect::Message> message_at(wire::ByteView bytes, std::size_t offset) {
    const std::size_t size = delta_t_bytes(bytes);
    if (size == 0) return std::nullopt;
    const auto message = parse_delta_t(bytes.first(size));
    if (!message) return std::nullopt;
    inspect::Message out{
        .offset = offset, .size = size, .name = name_of(*message), .fields = {}, .reason = ""};
    std::visit([&](const auto& m) { inspect::add_fields(out, m); }, *message);
    return out;
}

}  // namespace

std::vector<inspect::Message> decode_delta_t(wire::ByteView bytes) {
    std::vector<inspect::Message> out;
    std::size_t covered = 0;
    for (std::size_t at = 0; at < bytes.size();) {
        auto message = message_at(bytes.subspan(at), at);
        if (!message) {
            ++at;
            continue;
        }
        if (at > covered) out.push_back(inspect::stream_noise(covered, at));
        covered = at += message->size;
        out.push_back(*std::move(message));
    }
    if (covered < bytes.size()) out.push_back(inspect::stream_noise(covered, bytes.size()));
    return out;
}

bool recognise_delta_t(wire::ByteView bytes) {
    const std::size_t size = delta_t_bytes(bytes);
    if (size == 0) return false;
    const auto message = parse_delta_t(bytes.first(size));
    return message && std::visit([](const auto& m) { return is_plain(m); }, *message);
}

std::vector<wire::Table> delta_t_tables() {
    return {wire::table_of<Profile83P>(), wire::table_of<ExternalControl>()};
}

wire::Bytes rewritten_delta_t(wire::ByteView bytes) {
    const auto message = parse_delta_t(bytes);
    return message ? encode(*message) : wire::Bytes{};
}

}  // namespace echoloop::imagenex
