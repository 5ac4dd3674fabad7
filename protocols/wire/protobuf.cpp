#include "protocols/wire/protobuf.h"

namespace echoloop::wire::protobuf {

ByteView Cursor::take(std::uint64_t count) {
    if (count > bytes.size() - at) fine = false;
    if (!fine) return {};
    at += count;
    return bytes.subspan(at - count, count);
}

void Cursor::skip(std::uint32_t type) {
    if (type == WireType::varint)
        varint();
    else if (type == WireType::block)
        block();
    else if (type == fixed32 || type == fixed64)
        take(type == fixed32 ? 4 : 8);
    else
        fine = false;  // groups are no part of proto3
}

void put_varint(std::uint64_t value, Bytes& out) {
    for (; value >= 0x80; value >>= 7) out.push_back(static_cast<std::uint8_t>(value | 0x80));
    out.push_back(static_cast<std::uint8_t>(value));
}

void put_float(float value, Bytes& out) {
    out.resize(out.size() + 4);
    store<ByteOrder::little>(value, out.data() + out.size() - 4);
}

void put_block(ByteView bytes, Bytes& out) {
    put_varint(bytes.size(), out);
    out.insert(out.end(), bytes.begin(), bytes.end());
}

}  // namespace echoloop::wire::protobuf
