// Messages to bytes by their tables. Counts and sizes follow from the arrays, so what it writes never
// contradicts itself.
#pragma once

#include "protocols/wire/write_sections.h"
#include "protocols/wire/writer.h"

namespace echoloop::wire {

template <class M>
void write_fields(Writer& writer, const M& message) {
    std::apply([&](const auto&... fields) { (write_field(writer, message, fields), ...); }, layout<M>.fields);
}

/// All bytes of the message. An array whose size contradicts the counts is cut or filled up with zeros.
template <class M>
Bytes serialise(const M& message) {
    Writer writer;
    if constexpr (constexpr FixedSize size = fixed_size<M>(); size) writer.out.reserve(*size);
    writer.counts.message(message);
    write_fields(writer, message);
    if (writer.set_size != nullptr) writer.set_size(writer.out, writer.size_at);
    return std::move(writer.out);
}

}  // namespace echoloop::wire
