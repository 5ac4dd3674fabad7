// Bytes to messages by their tables. Stops at the first error and never allocates more than the bytes that
// are there.
#pragma once

#include "protocols/wire/read_sections.h"
#include "protocols/wire/reader.h"

namespace echoloop::wire {

template <class M>
bool read_fields(Reader& reader, M& message) {
    return std::apply([&](const auto&... fields) { return (read_field(reader, message, fields) && ...); },
                      layout<M>.fields);
}

/// The message that these bytes are, all of them.
template <class M>
Result<M> parse(ByteView bytes) {
    Reader reader{.bytes = bytes, .base = layout<M>.base};
    M message{};
    if (!read_fields(reader, message)) return reader.error;
    if (reader.left() != 0) {
        reader.fail(Reason::trailing_bytes, layout<M>.name, "");
        return reader.error;
    }
    return message;
}

}  // namespace echoloop::wire
