#include "protocols/wayfinder/codec.h"

#include <algorithm>
#include <numeric>

#include "protocols/wayfinder/layouts.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::wayfinder {
namespace {

constexpr std::uint8_t fixed_begin[] = {0xAA, 0x10, 0x01};
constexpr std::size_t sum_size = 2, outer_size = 5 + sum_size;  // bytes around the inner packet
constexpr std::size_t packet_version_at = 5;
constexpr std::uint8_t packet_version = 2;
using Found = wire::Found<wire::Bytes>;

std::size_t word_at(wire::ByteView bytes, std::size_t at) { return bytes[at] + 256U * bytes[at + 1]; }

void put_word(wire::Bytes& bytes, std::size_t at, std::size_t value) {
    bytes[at] = static_cast<std::uint8_t>(value);
    bytes[at + 1] = static_cast<std::uint8_t>(value >> 8);
}

void append_sum(wire::Bytes& bytes) {
    const std::uint16_t total = sum(bytes);
    bytes.resize(bytes.size() + sum_size);
    put_word(bytes, bytes.size() - sum_size, total);
}

/// Whether all bytes that are there may begin a packet.
bool may_begin(wire::ByteView pending) {
    for (std::size_t i = 0; i < std::min(pending.size(), std::size(fixed_begin)); ++i)
        if (pending[i] != fixed_begin[i]) return false;
    if (pending.size() > packet_version_at && pending[packet_version_at] != packet_version) return false;
    if (pending.size() >= packet_version_at) {
        const std::size_t size = word_at(pending, 3);
        if (size < header_size + sum_size || size > longest_packet) return false;
        if (pending.size() >= header_size && word_at(pending, 7) + outer_size != size) return false;
    }
    return true;
}

template <class M>
wire::Result<Body> body_of(wire::ByteView payload) {
    auto body = wire::parse<M>(payload);
    if (!body) return body.error();
    return Body(*std::move(body));
}

/// As M, if the bytes are such; else as `Plain`, which takes all.
template <class M, class Plain>
wire::Result<Body> body_or(wire::ByteView payload) {
    auto body = body_of<M>(payload);
    return body ? body : body_of<Plain>(payload);
}

wire::Result<Body> set_setup(wire::ByteView payload) {
    auto setup = body_of<SetSetup>(payload);
    return setup ? setup : body_or<SetOlderSetup, Command>(payload);
}

wire::Result<Body> read_command(wire::ByteView payload) {
    const auto command = wire::parse<Command>(payload);
    if (!command) return command.error();
    switch (command->command) {
        case CommandId::set_time:
            return body_or<SetTime, Command>(payload);
        case CommandId::set_setup:
            return set_setup(payload);
        case CommandId::set_sound_speed:
            return body_or<SetSoundSpeed, Command>(payload);
        default:
            return Body(*command);
    }
}

wire::Result<Body> read_response(wire::ByteView payload) {
    const auto response = wire::parse<Response>(payload);
    if (!response) return response.error();
    if (const auto refusal = wire::parse<Refusal>(payload)) return Body(*refusal);
    switch (response->command) {
        case CommandId::get_time:
            return body_or<TimeResponse, Response>(payload);
        case CommandId::get_setup:
            return body_or<SetupResponse, Response>(payload);
        case CommandId::get_system:
            return body_or<SystemResponse, Response>(payload);
        case CommandId::get_features:
            return body_or<FeaturesResponse, Response>(payload);
        case CommandId::get_tests:
            return body_or<TestsResponse, Response>(payload);
        case CommandId::get_components:
            return body_or<ComponentsResponse, Response>(payload);
        default:
            return Body(*response);
    }
}

wire::Result<Body> read_data(wire::ByteView payload) {
    const auto data = wire::parse<Data>(payload);
    if (!data) return body_of<Other>(payload);
    if (data->checksum != sum(payload.first(payload.size() - sum_size)))
        return wire::Error{"Data", "checksum", payload.size() - sum_size, wire::Reason::wrong_constant};
    return Body(*data);
}

wire::Result<Body> read_body(Kind kind, wire::ByteView payload) {
    switch (kind) {
        case Kind::command:
            return read_command(payload);
        case Kind::response:
            return read_response(payload);
        case Kind::data:
            return read_data(payload);
        default:
            return body_of<Other>(payload);
    }
}

wire::Bytes payload_of(const Body& body) {
    wire::Bytes bytes = std::visit([](const auto& b) { return wire::serialise(b); }, body);
    if (!std::holds_alternative<Data>(body)) return bytes;
    bytes.resize(bytes.size() - sum_size);
    append_sum(bytes);
    return bytes;
}

}  // namespace

std::uint16_t sum(wire::ByteView bytes) {
    return static_cast<std::uint16_t>(std::accumulate(bytes.begin(), bytes.end(), 0U));
}

wire::Bytes encode(const Packet& packet) {
    const wire::Bytes payload = payload_of(packet.body);
    const std::size_t inner = payload.size() + header_size - packet_version_at;
    wire::Bytes bytes = wire::serialise(Header{static_cast<std::uint16_t>(inner + outer_size), packet.kind,
                                               static_cast<std::uint16_t>(inner)});
    bytes.insert(bytes.end(), payload.begin(), payload.end());
    append_sum(bytes);
    return bytes;
}

wire::Result<Packet> parse(wire::ByteView bytes) {
    if (bytes.size() < header_size + sum_size || !may_begin(bytes) || word_at(bytes, 3) != bytes.size())
        return wire::Error{"Header", "size", 3, wire::Reason::wrong_constant};
    const auto summed = bytes.first(bytes.size() - sum_size);
    if (sum(summed) != word_at(bytes, summed.size()))
        return wire::Error{"Header", "checksum", summed.size(), wire::Reason::wrong_constant};
    const auto kind = static_cast<Kind>(bytes[packet_version_at + 1]);
    auto body = read_body(kind, summed.subspan(header_size));
    if (!body) return body.error();
    return Packet{kind, *std::move(body)};
}

wire::Found<wire::Bytes> PacketFinder::find(wire::ByteView pending, bool finished) const {
    if (!may_begin(pending)) return {wire::bytes_before(fixed_begin[0], pending)};
    const bool sized = pending.size() >= packet_version_at;
    const std::size_t size = sized ? word_at(pending, 3) : 0;
    if (!sized || pending.size() < size)
        return finished ? Found{wire::bytes_before(fixed_begin[0], pending)} : Found{};
    const auto bytes = pending.first(size);
    if (sum(bytes.first(size - sum_size)) != word_at(bytes, size - sum_size))
        return {wire::bytes_before(fixed_begin[0], pending)};
    return {0, size, wire::Bytes(bytes.begin(), bytes.end())};
}

}  // namespace echoloop::wayfinder
