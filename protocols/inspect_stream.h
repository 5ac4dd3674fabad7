// Reads a byte stream of framed messages for inspection: what any family with a wire::Framer does. Knows no
// family.
#pragma once

#include <algorithm>
#include <vector>

#include "protocols/inspect.h"
#include "protocols/wire/visit.h"

namespace echoloop::inspect {

inline constexpr std::size_t stream_chunk = 4096;

/// Appends the fields of one part of a message.
void add_fields(Message& message, const auto& part) {
    wire::visit_fields(
        part, [&](const wire::FieldView& view) { message.fields.push_back(to_field(view, message.offset)); });
}

inline Message stream_noise(std::size_t from, std::size_t to) {
    return {.offset = from, .size = to - from, .name = "", .fields = {}, .reason = "no complete frame"};
}

/// All frames of a stream, made into messages by `inspected(frame, offset, size)`, with the noise between
/// them.
template <class Framer, class Inspected>
std::vector<Message> decode_stream(wire::ByteView bytes, const Inspected& inspected) {
    std::vector<Message> out;
    Framer framer;
    std::size_t covered = 0;
    const auto take = [&] {
        while (const auto frame = framer.next()) {
            const std::size_t at = framer.frame_offset();
            if (at > covered) out.push_back(stream_noise(covered, at));
            out.push_back(inspected(*frame, at, framer.frame_size()));
            covered = at + out.back().size;
        }
    };
    for (std::size_t from = 0; from < bytes.size(); from += stream_chunk) {
        framer.feed(bytes.subspan(from, std::min(stream_chunk, bytes.size() - from)));
        take();
    }
    framer.finish();
    take();
    if (covered < bytes.size()) out.push_back(stream_noise(covered, bytes.size()));
    return out;
}

/// Whether the stream holds a frame.
template <class Framer>
bool recognise_stream(wire::ByteView bytes) {
    Framer framer;
    for (std::size_t from = 0; from < bytes.size(); from += stream_chunk) {
        framer.feed(bytes.subspan(from, std::min(stream_chunk, bytes.size() - from)));
        if (framer.next()) return true;
    }
    framer.finish();
    return framer.next().has_value();
}

/// What `rewrite(frame)` makes of the first frame; empty if there is none.
template <class Framer, class Rewrite>
wire::Bytes rewritten_frame(wire::ByteView bytes, const Rewrite& rewrite) {
    Framer framer;
    framer.feed(bytes);
    framer.finish();
    const auto frame = framer.next();
    return frame ? rewrite(*frame) : wire::Bytes{};
}

}  // namespace echoloop::inspect
