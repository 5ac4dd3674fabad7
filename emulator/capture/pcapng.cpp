#include "emulator/capture/pcapng.h"

#include <algorithm>

namespace echoloop::pcapng {
namespace {

constexpr std::uint16_t comment_option = 1, application_option = 4;              // any block; section header
constexpr std::uint16_t name_option = 2, description_option = 3, time_unit = 9;  // interface
constexpr std::uint16_t flags_option = 2;                                        // packet
constexpr std::size_t longest_option = 65535;

/// Appends little-endian numbers and options; every option and packet is padded to four bytes.
class Block {
  public:
    explicit Block(std::uint32_t type) {
        u32(type);
        u32(0);  // the length, known at the end
    }
    void u16(std::uint16_t value) { number(value, 2); }
    void u32(std::uint32_t value) { number(value, 4); }
    void padded(ByteView bytes) {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
    }
    void option(std::uint16_t code, ByteView value) {
        value = value.first(std::min(value.size(), longest_option));
        u16(code);
        u16(static_cast<std::uint16_t>(value.size()));
        padded(value);
    }
    void option(std::uint16_t code, const std::string& text) {
        if (!text.empty())
            option(code, ByteView(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
    }
    Bytes finish() {
        const auto length = static_cast<std::uint32_t>(bytes_.size() + 4);
        u32(length);
        for (std::size_t i = 0; i < 4; ++i) bytes_[4 + i] = bytes_[bytes_.size() - 4 + i];
        return std::move(bytes_);
    }
    void end_of_options() { u32(0); }

  private:
    void number(std::uint32_t value, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> 8 * i));
    }
    Bytes bytes_;
};

}  // namespace

Bytes section_header(const std::string& application) {
    Block block(0x0A0D0D0A);
    block.u32(0x1A2B3C4D);  // byte order
    block.u16(1);           // version 1.0
    block.u16(0);
    block.u32(0xFFFFFFFF);  // length of the section: not known
    block.u32(0xFFFFFFFF);
    block.option(application_option, application);
    block.end_of_options();
    return block.finish();
}

Bytes interface_description(LinkType type, const std::string& name, const std::string& description) {
    constexpr std::uint8_t nanoseconds[] = {9};  // 10^-9 s
    Block block(1);
    block.u16(static_cast<std::uint16_t>(type));
    block.u16(0);
    block.u32(0);  // packets are never cut
    block.option(name_option, name);
    block.option(description_option, description);
    block.option(time_unit, nanoseconds);
    block.end_of_options();
    return block.finish();
}

Bytes enhanced_packet(const Packet& packet, ByteView bytes) {
    const auto time = static_cast<std::uint64_t>(packet.time.count());
    Block block(6);
    block.u32(packet.interface);
    block.u32(static_cast<std::uint32_t>(time >> 32));
    block.u32(static_cast<std::uint32_t>(time));
    block.u32(static_cast<std::uint32_t>(bytes.size()));
    block.u32(static_cast<std::uint32_t>(bytes.size()));
    block.padded(bytes);
    const std::uint8_t flags[] = {static_cast<std::uint8_t>(packet.direction), 0, 0, 0};
    block.option(flags_option, flags);
    block.option(comment_option, packet.comment);
    block.end_of_options();
    return block.finish();
}

}  // namespace echoloop::pcapng
