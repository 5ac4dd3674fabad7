#include "protocols/oculus/framer.h"

#include "protocols/oculus/layouts.h"

namespace echoloop::oculus {
namespace {

/// Where another header begins within the first `size` bytes; 0 if none does.
std::size_t header_within(wire::ByteView bytes, std::size_t size, std::size_t longest) {
    for (std::size_t at = 1; at < size && at + header_bytes <= bytes.size(); ++at)
        if (bytes[at] == 'S' && plausible_header(bytes.subspan(at), longest)) return at;
    return 0;
}

}  // namespace

wire::FramerLimits MessageFinder::limits() const { return {.before = longest_ + header_bytes}; }

wire::Found<Frame> MessageFinder::find(wire::ByteView pending, bool finished) const {
    const wire::Found<Frame> noise{wire::bytes_before('S', pending)};
    const auto header = plausible_header(pending, longest_);
    if (!header) {
        const bool may_begin = pending[0] == 'S' && (pending.size() < 2 || pending[1] == 'O');
        return may_begin && pending.size() < header_bytes && !finished ? wire::Found<Frame>{} : noise;
    }
    const std::size_t size = header_bytes + payload_bytes(*header);

    // An image may hold anything, leftovers of older headers too.
    const bool short_one = payload_bytes(*header) <= status_payload;
    const std::size_t inner = short_one ? header_within(pending, size, longest_) : 0;
    if (inner > 0) return {inner};
    if (pending.size() < size) return finished ? noise : wire::Found<Frame>{};
    const wire::ByteView payload = pending.first(size).subspan(header_bytes);
    return {0, size, Frame{*header, wire::Bytes(payload.begin(), payload.end())}};
}

}  // namespace echoloop::oculus
