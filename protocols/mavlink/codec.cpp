#include "protocols/mavlink/codec.h"

#include <algorithm>

#include "protocols/mavlink/layouts.h"
#include "protocols/wire/read.h"

namespace echoloop::mavlink {
namespace {

template <class M>
std::optional<Message> parse_as(wire::Bytes payload) {
    payload.resize(*wire::fixed_size<M>());
    auto message = wire::parse<M>(payload);
    if (!message) return {};
    return Message(*std::move(message));
}

struct Row {
    Id id;
    std::uint8_t seed;  ///< from the definition's names and types
    std::optional<Message> (*parse)(wire::Bytes);
};
constexpr Row rows[] = {
    {Id::attitude, 39, parse_as<Attitude>},
    {Id::attitude_quaternion, 246, parse_as<AttitudeQuaternion>},
    {Id::local_position_ned, 185, parse_as<LocalPositionNed>},
    {Id::global_position_int, 104, parse_as<GlobalPositionInt>},
    {Id::sim_state, 32, parse_as<SimState>},
    {Id::odometry, 91, parse_as<Odometry>},
};
static_assert(std::size(rows) == std::variant_size_v<Message>);

const Row* find_row(std::uint32_t id) {
    const auto* row = std::ranges::find(rows, static_cast<Id>(id), &Row::id);
    return row == std::end(rows) ? nullptr : row;
}

}  // namespace

std::optional<Message> parse(const Frame& frame) {
    const Row* row = find_row(frame.id);
    return row == nullptr ? std::nullopt : row->parse(frame.payload);
}

std::uint16_t checksum(wire::ByteView bytes, std::uint8_t seed) {
    std::uint16_t crc = 0xFFFF;
    const auto add = [&crc](std::uint8_t byte) {
        std::uint8_t low = static_cast<std::uint8_t>(byte ^ (crc & 0xFF));
        low = static_cast<std::uint8_t>(low ^ (low << 4));
        crc = static_cast<std::uint16_t>((crc >> 8) ^ (low << 8) ^ (low << 3) ^ (low >> 4));
    };
    std::ranges::for_each(bytes, add);
    add(seed);
    return crc;
}

std::optional<std::uint8_t> checksum_seed(std::uint32_t id) {
    const Row* row = find_row(id);
    return row == nullptr ? std::nullopt : std::optional(row->seed);
}

}  // namespace echoloop::mavlink
