#include "tools/capture/pcapng_reader.h"

#include <algorithm>
#include <cmath>

namespace echoloop::capture {
namespace {

constexpr std::size_t largest_block = 16 << 20, most_interfaces = 65536;
constexpr std::size_t frame = 12;  // type and length, and the length again
constexpr std::uint32_t interface_block = 1, simple_block = 3, enhanced_block = 6, section_block = 0x0A0D0D0A;

std::string text_of(ByteView bytes) {
    const auto end = std::ranges::find(bytes, std::uint8_t{0});
    return {bytes.begin(), end};
}

/// Ticks in a second from the byte of if_tsresol; 0 if it is absurd.
std::uint64_t ticks(std::uint8_t resolution) {
    const int exponent = resolution & 0x7F;
    const bool binary = (resolution & 0x80) != 0;
    if (exponent > (binary ? 62 : 18)) return 0;
    return binary ? std::uint64_t{1} << exponent
                  : static_cast<std::uint64_t>(std::llround(std::pow(10, exponent)));
}

pcapng::WallTime time_of(std::uint64_t count, std::uint64_t per_second) {
    constexpr std::uint64_t most_seconds = 9'000'000'000;
    const std::uint64_t seconds = std::min(count / per_second, most_seconds);
    const double rest = static_cast<double>(count % per_second) / static_cast<double>(per_second);
    return std::chrono::seconds(seconds) + std::chrono::nanoseconds(std::llround(rest * 1e9));
}

}  // namespace

std::uint16_t PcapngReader::u16(ByteView bytes, std::size_t at) const {
    return static_cast<std::uint16_t>(big_endian_ ? bytes[at] << 8 | bytes[at + 1]
                                                  : bytes[at] | bytes[at + 1] << 8);
}

std::uint32_t PcapngReader::u32(ByteView bytes, std::size_t at) const {
    const std::uint32_t first = u16(bytes, at), second = u16(bytes, at + 2);
    return big_endian_ ? first << 16 | second : first | second << 16;
}

std::optional<RawPacket> PcapngReader::fail(const std::string& why) {
    fault_ = why;
    return {};
}

std::optional<RawPacket> PcapngReader::next() {
    while (fault_.empty()) {
        auto block = read_block();
        if (!block) return {};
        body_ = std::move(block->body);
        if (block->type == section_block) describe_section(body_);
        if (block->type == interface_block) add_interface(body_);
        if (block->type == enhanced_block) return enhanced(body_);
        if (block->type == simple_block) return simple(body_);
    }
    return {};
}

/// A section says which byte order holds from here on. `start`: the first bytes of its block.
bool PcapngReader::begin_section(Bytes& start) {
    const Bytes magic = read_(4);
    start.insert(start.end(), magic.begin(), magic.end());
    if (start.size() < frame) return false;
    big_endian_ = start[8] == 0x1A;
    interfaces_.clear();
    return u32(start, 8) == 0x1A2B3C4D;
}

template <class Each>
void PcapngReader::options(ByteView list, Each each) const {
    while (list.size() >= 4) {
        const std::uint16_t code = u16(list, 0), size = u16(list, 2);
        const std::size_t whole = 4 + (std::size_t{size} + 3) / 4 * 4;
        if (code == 0 || whole > list.size()) return;
        each(code, list.subspan(4, size));
        list = list.subspan(whole);
    }
}

/// `body`: behind the byte order mark.
void PcapngReader::describe_section(ByteView body) {
    constexpr std::size_t version_and_length = 12;
    constexpr std::uint16_t user_application = 4;
    application_.clear();
    if (body.size() < version_and_length) return;
    options(body.subspan(version_and_length), [this](std::uint16_t code, ByteView value) {
        if (code == user_application) application_ = text_of(value);
    });
}

std::optional<PcapngReader::Block> PcapngReader::read_block() {
    const auto broken = [this](const char* why) -> std::optional<Block> {
        fault_ = why;
        return {};
    };
    Bytes start = read_(8);
    if (start.empty()) return {};
    if (start.size() < 8) return broken("the last block is cut short");
    if (std::ranges::equal(ByteView(start).first(4),
                           std::initializer_list<std::uint8_t>{0x0A, 0x0D, 0x0D, 0x0A}) &&
        !begin_section(start))
        return broken("a section header without its byte order mark");
    Block block{u32(start, 0), {}};
    const std::size_t length = u32(start, 4);
    if (length < std::max(frame, start.size() + 4) || length % 4 != 0 || length > largest_block)
        return broken("a block has an impossible length");
    block.body = read_(length - start.size());
    if (block.body.size() < length - start.size()) return broken("the last block is cut short");
    if (u32(block.body, block.body.size() - 4) != length) return broken("a block's two lengths differ");
    block.body.resize(block.body.size() - 4);
    return block;
}

void PcapngReader::add_interface(ByteView body) {
    if (body.size() < 8 || interfaces_.size() >= most_interfaces) {
        fault_ = "an interface that cannot be read";
        return;
    }
    Interface interface;
    interface.link_type = u16(body, 0);
    options(body.subspan(8), [&interface](std::uint16_t code, ByteView value) {
        if (code == 2) interface.name = text_of(value);
        if (code == 9 && !value.empty()) interface.ticks_per_second = ticks(value[0]);
    });
    if (interface.ticks_per_second == 0) fault_ = "an interface with an impossible time resolution";
    interfaces_.push_back(std::move(interface));
}

std::optional<RawPacket> PcapngReader::enhanced(ByteView body) {
    constexpr std::size_t head = 20;
    if (body.size() < head) return fail("a packet block is too short");
    const std::size_t number = u32(body, 0), captured = u32(body, 12);
    if (number >= interfaces_.size()) return fail("a packet of an interface that is not described");
    if (captured > body.size() - head) return fail("a packet is longer than its block");
    const Interface& interface = interfaces_[number];
    const std::uint64_t count = std::uint64_t{u32(body, 4)} << 32 | u32(body, 8);
    RawPacket packet{interface.link_type,
                     interface.name,
                     time_of(count, interface.ticks_per_second),
                     {},
                     body.subspan(head, captured),
                     u32(body, 16),
                     {}};
    const std::size_t padded = (captured + 3) / 4 * 4;
    if (head + padded <= body.size())
        options(body.subspan(head + padded), [&](std::uint16_t code, ByteView value) {
            if (code == 1) packet.comment = text_of(value);
            const std::uint32_t direction = code == 2 && value.size() >= 4 ? u32(value, 0) & 3 : 0;
            if (direction != 0) packet.sent = direction == 2;
        });
    return packet;
}

std::optional<RawPacket> PcapngReader::simple(ByteView body) {
    if (body.size() < 4 || interfaces_.empty()) return fail("a packet of an interface that is not described");
    const std::size_t original = u32(body, 0);
    return RawPacket{interfaces_[0].link_type,
                     interfaces_[0].name,
                     {},
                     {},
                     body.subspan(4, std::min(original, body.size() - 4)),
                     original,
                     {}};
}

}  // namespace echoloop::capture
