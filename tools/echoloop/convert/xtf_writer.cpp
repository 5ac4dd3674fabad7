#include "tools/echoloop/convert/xtf_writer.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "protocols/wire/bytes.h"

namespace echoloop::convert::xtf {
namespace {

constexpr std::size_t header_bytes = 1024, channel_info_at = 256, channel_info_bytes = 128;
constexpr std::size_t ping_header_bytes = 256, channel_header_bytes = 64, unit = 64;

class Block {
  public:
    explicit Block(std::size_t size) : bytes_(size) {}
    template <class T>
    void set(std::size_t at, T value) {
        wire::store<wire::ByteOrder::little>(value, bytes_.data() + at);
    }
    void text(std::size_t at, std::string_view text) {
        std::ranges::copy(text, bytes_.begin() + static_cast<std::ptrdiff_t>(at));
    }
    Bytes& bytes() { return bytes_; }

  private:
    Bytes bytes_;
};

void write_info(Block& header, std::size_t at, std::uint8_t number, const Channel& channel) {
    constexpr std::uint16_t slant = 1, unipolar = 1;
    constexpr std::uint8_t port_type = 1, starboard_type = 2, sixteen_bits = 3, eight_bits = 8;
    header.set(at, channel.starboard ? starboard_type : port_type);
    header.set(at + 1, number);
    header.set(at + 2, slant);
    header.set(at + 4, unipolar);
    header.set(at + 6, static_cast<std::uint16_t>(channel.sample_bytes));
    header.set(at + 8, std::uint32_t{1024});
    header.text(at + 12, channel.starboard ? "starboard" : "port");
    header.set(at + 32, static_cast<float>(channel.kilohertz));
    header.set(at + 74, channel.sample_bytes == 1 ? eight_bits : sixteen_bits);
}

void write_ping(Block& packet, const Ping& ping) {
    const std::time_t seconds = ping.seconds;
    std::tm at{};
    ::gmtime_r(&seconds, &at);
    const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
    packet.set(14, static_cast<std::uint16_t>(at.tm_year + 1900));
    const std::array<int, 5> date{at.tm_mon + 1, at.tm_mday, at.tm_hour, at.tm_min, at.tm_sec};
    for (std::size_t i = 0; i < date.size(); ++i) packet.set(16 + i, byte(date[i]));
    packet.set(21, byte(static_cast<int>(ping.milliseconds / 10)));
    packet.set(22, static_cast<std::uint16_t>(at.tm_yday + 1));
    packet.set(28, ping.number);
    packet.set(32, ping.sound_speed / 2);  // by convention that of one way
    packet.set(72, ping.sound_speed);
    if (ping.speed)
        for (const std::size_t place : {120U, 152U}) packet.set(place, *ping.speed);
    if (ping.heading)
        for (const std::size_t place : {124U, 212U}) packet.set(place, *ping.heading);
    if (ping.position)
        for (const std::size_t place : {128U, 160U}) {
            packet.set(place, (*ping.position)[0]);
            packet.set(place + 8, (*ping.position)[1]);
        }
    if (ping.depth) packet.set(192, *ping.depth);
    if (ping.altitude) packet.set(196, *ping.altitude);
    if (ping.pitch_roll) {
        packet.set(204, (*ping.pitch_roll)[0]);
        packet.set(208, (*ping.pitch_roll)[1]);
    }
}

/// Where the next one begins.
std::size_t write_side(Block& packet, std::size_t at, const Side& side) {
    const std::size_t size = side.sample_bytes, count = side.samples.size() / size;
    packet.set(at, side.channel);
    packet.set(at + 4, static_cast<float>(side.slant_range));
    packet.set(at + 12, static_cast<float>(side.delay));
    packet.set(at + 16, static_cast<float>(side.duration));
    packet.set(at + 20, static_cast<float>(side.duration));
    packet.set(at + 26, static_cast<std::uint16_t>(std::lround(side.kilohertz)));
    packet.set(at + 42, static_cast<std::uint32_t>(count));
    at += channel_header_bytes;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t from = side.starboard ? i : count - 1 - i;
        for (std::size_t k = 0; k < size; ++k) packet.set(at + size * i + k, side.samples[size * from + k]);
    }
    return at + side.samples.size();
}

}  // namespace

Bytes file_header(std::string_view sonar, std::span<const Channel> channels, Units units) {
    constexpr std::uint16_t metres = 0, latitude_longitude = 3;
    Block header(header_bytes);
    header.set(0, std::uint8_t{0x7B});
    header.set(1, std::uint8_t{1});
    header.text(2, "echoloop");
    header.text(10, "223");
    header.text(18, sonar);
    header.set(164, units == Units::metres ? metres : latitude_longitude);
    header.set(166, static_cast<std::uint16_t>(channels.size()));
    for (std::size_t i = 0; i < channels.size(); ++i)
        write_info(header, channel_info_at + i * channel_info_bytes, static_cast<std::uint8_t>(i),
                   channels[i]);
    return std::move(header.bytes());
}

Bytes packet(const Ping& ping, std::span<const Side> sides) {
    std::size_t size = ping_header_bytes;
    for (const Side& side : sides) size += channel_header_bytes + side.samples.size();
    Block block((size + unit - 1) / unit * unit);
    block.set(0, std::uint16_t{0xFACE});
    block.set(4, static_cast<std::uint16_t>(sides.size()));
    block.set(10, static_cast<std::uint32_t>(block.bytes().size()));
    write_ping(block, ping);
    std::size_t at = ping_header_bytes;
    for (const Side& side : sides) at = write_side(block, at, side);
    return std::move(block.bytes());
}

}  // namespace echoloop::convert::xtf
