#include "protocols/aris/protobuf.h"

namespace echoloop::aris::protobuf {

std::uint64_t Taker::number() {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < 10 && i < left_.size(); ++i) {
        value |= std::uint64_t{left_[i] & 0x7FU} << 7 * i;
        if (left_[i] >= 0x80) continue;
        left_ = left_.subspan(i + 1);
        return value;
    }
    good_ = false;
    return 0;
}

wire::ByteView Taker::bytes(std::uint64_t count) {
    if (!good_ || count > left_.size()) {
        good_ = false;
        return {};
    }
    const wire::ByteView taken = left_.first(count);
    left_ = left_.subspan(count);
    return taken;
}

void Taker::skip(std::uint32_t kind) {
    if (kind == varint)
        number();
    else if (kind == block)
        sized();
    else if (kind == fixed32 || kind == fixed64)
        bytes(kind == fixed32 ? 4 : 8);
    else
        good_ = false;
}

void put_number(std::uint64_t value, wire::Bytes& out) {
    while (value >= 0x80) {
        out.push_back(static_cast<std::uint8_t>(value & 0x7F) | 0x80);
        value >>= 7;
    }
    out.push_back(static_cast<std::uint8_t>(value));
}

void put_sized(wire::ByteView bytes, wire::Bytes& out) {
    put_number(bytes.size(), out);
    out.insert(out.end(), bytes.begin(), bytes.end());
}

void put_float(float value, wire::Bytes& out) {
    out.resize(out.size() + 4);
    wire::store<wire::ByteOrder::little>(value, out.data() + out.size() - 4);
}

}  // namespace echoloop::aris::protobuf
