#include "protocols/imagenex/delta_t_codec.h"

#include <algorithm>
#include <string_view>

#include "protocols/imagenex/delta_t_layouts.h"
#include "protocols/imagenex/starts_with.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::imagenex {
namespace {

using wire::ByteView;

static_assert(wire::fixed_size<ExternalControl>() == control_bytes);

constexpr std::size_t floats_at[] = {100, 104, 108, 128, 133, 138, 142, 146, 151};

template <class M>
wire::Result<DeltaTMessage> parse_as(ByteView bytes) {
    auto message = wire::parse<M>(bytes);
    if (!message) return message.error();
    return DeltaTMessage(*std::move(message));
}

}  // namespace

wire::Result<DeltaTMessage> parse_delta_t(ByteView bytes) {
    return starts_with(bytes, "E") ? parse_as<ExternalControl>(bytes) : parse_as<Profile83P>(bytes);
}

wire::Bytes encode(const DeltaTMessage& message) {
    return std::visit([](const auto& m) { return wire::serialise(m); }, message);
}

wire::Bytes encode_with_little_floats(const Profile83P& profile) {
    wire::Bytes bytes = wire::serialise(profile);
    for (const std::size_t at : floats_at) {
        const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(at);
        std::reverse(first, first + 4);
    }
    return bytes;
}

std::size_t delta_t_bytes(ByteView bytes) {
    std::size_t size = 0;
    if (starts_with(bytes, "EC")) size = control_bytes;
    if (starts_with(bytes, "83P") && bytes.size() >= profile_header_bytes)
        size = wire::load<ByteOrder::big, std::uint16_t>(bytes.data() + 4);
    return size >= profile_header_bytes && size <= bytes.size() ? size : 0;
}

std::string name_of(const DeltaTMessage& message) {
    return std::holds_alternative<Profile83P>(message) ? "83P" : "EC";
}

}  // namespace echoloop::imagenex
