#include "protocols/reson7k/codec.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numeric>

#include "protocols/reson7k/layouts.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::reson7k {
namespace {

static_assert(wire::fixed_size<NetworkFrame>() == network_frame_size);
static_assert(wire::fixed_size<RecordFrame>() == record_frame_size);
static_assert(wire::fixed_size<SonarSettings>() == 156);
static_assert(12 + *wire::fixed_size<Settings>() + *wire::fixed_size<Conditions>() +
                  *wire::fixed_size<RemoteExtras>() ==
              260);
static_assert(wire::fixed_size<Detection>() == 34);

constexpr std::uint16_t version = 5;
constexpr std::size_t size_at = 8;

/// A widespread host counts the content from the frame's first byte, as 64; it stands in the same place.
constexpr bool is_content_offset(std::uint16_t offset) {
    return offset == record_frame_size - 4 || offset == record_frame_size;
}

/// Eight bytes at a time, as four sums of 16 bits, which hold no more than 128 times two bytes.
std::uint32_t sum_of(wire::ByteView bytes) {
    constexpr std::size_t word = sizeof(std::uint64_t), most = 128;
    constexpr std::uint64_t every_other = 0x00FF00FF00FF00FF;
    std::uint32_t sum = 0;
    while (bytes.size() >= word) {
        const std::size_t words = std::min(bytes.size() / word, most);
        std::uint64_t sums = 0;
        for (std::size_t i = 0; i < words; ++i) {
            std::uint64_t eight = 0;
            std::memcpy(&eight, bytes.data() + i * word, word);
            sums += (eight & every_other) + (eight >> 8 & every_other);
        }
        for (int shift = 0; shift < 64; shift += 16) sum += static_cast<std::uint16_t>(sums >> shift);
        bytes = bytes.subspan(words * word);
    }
    return std::accumulate(bytes.begin(), bytes.end(), sum);
}

template <class M>
wire::Result<Message> parse_as(wire::ByteView content) {
    auto message = wire::parse<M>(content);
    if (!message) return message.error();
    return Message(*std::move(message));
}

template <std::size_t I = 0>
wire::Result<Message> parse_type(std::uint32_t type, wire::ByteView content) {
    if constexpr (I < std::variant_size_v<Message>) {
        using M = std::variant_alternative_t<I, Message>;
        return type == M::type ? parse_as<M>(content) : parse_type<I + 1>(type, content);
    } else {
        return wire::Error{"RecordFrame", "type", 32, wire::Reason::unknown_message};
    }
}

template <std::size_t I = 0>
std::string find_name(std::uint32_t type) {
    if constexpr (I < std::variant_size_v<Message>) {
        using M = std::variant_alternative_t<I, Message>;
        return type == M::type ? std::string(wire::layout<M>.name) : find_name<I + 1>(type);
    } else {
        return "record " + std::to_string(type);
    }
}

}  // namespace

std::optional<NetworkFrame> plausible_network_frame(wire::ByteView bytes, std::size_t longest) {
    if (bytes.size() < network_frame_size) return std::nullopt;
    const auto frame = wire::parse<NetworkFrame>(bytes.first(network_frame_size));
    if (!frame || frame->version != version || frame->offset != network_frame_size) return std::nullopt;
    const std::size_t data = frame->packet_size - std::min<std::size_t>(frame->packet_size, frame->offset);
    const bool fits = data > 0 && frame->packet_size <= 65535 && data <= frame->total_size &&
                      frame->total_size >= least_record && frame->total_size <= longest;
    const bool counts = frame->records == 1 && frame->packets > 0 && frame->sequence < frame->packets &&
                        frame->packets <= frame->total_size &&
                        (frame->packets > 1) == (data < frame->total_size);
    if (!fits || !counts) return std::nullopt;
    return *frame;
}

std::optional<RecordFrame> plausible_record_frame(wire::ByteView bytes, std::size_t longest) {
    if (bytes.size() < record_frame_size) return std::nullopt;
    const auto frame = wire::parse<RecordFrame>(bytes.first(record_frame_size));
    const bool good = frame && frame->version == version && is_content_offset(frame->offset) &&
                      frame->sync == sync_word && frame->size >= least_record && frame->size <= longest;
    if (!good) return std::nullopt;
    return *frame;
}

std::optional<Record> read_record(wire::ByteView bytes) {
    const auto frame = plausible_record_frame(bytes);
    if (!frame || frame->size != bytes.size()) return std::nullopt;
    const std::size_t end = bytes.size() - checksum_size;
    const auto checksum = wire::load<wire::ByteOrder::little, std::uint32_t>(bytes.data() + end);
    if ((frame->flags & checksum_valid) != 0 && checksum != sum_of(bytes.first(end))) return std::nullopt;
    return Record{*frame, wire::Bytes(bytes.begin() + record_frame_size,
                                      bytes.begin() + static_cast<std::ptrdiff_t>(end))};
}

wire::Result<Message> parse(const Record& record) { return parse_type(record.frame.type, record.content); }

wire::Bytes encode(const Message& message, RecordFrame frame) {
    frame.type = std::visit([](const auto& m) { return m.type; }, message);
    wire::Writer writer;
    wire::write_fields(writer, frame);
    std::visit(
        [&](const auto& m) {
            writer.counts.message(m);
            wire::write_fields(writer, m);
        },
        message);
    writer.grow(checksum_size);
    seal(writer.out);
    return std::move(writer.out);
}

wire::Bytes encode(const Record& record) {
    wire::Bytes bytes = wire::serialise(record.frame);
    bytes.insert(bytes.end(), record.content.begin(), record.content.end());
    bytes.resize(bytes.size() + checksum_size);
    seal(bytes);
    return bytes;
}

void seal(wire::Bytes& record) {
    constexpr std::size_t flags_at = 48;
    wire::store<wire::ByteOrder::little>(static_cast<std::uint32_t>(record.size()), record.data() + size_at);
    const std::size_t end = record.size() - checksum_size;
    const bool wanted = (record[flags_at] & checksum_valid) != 0;
    const std::uint32_t sum = wanted ? sum_of(wire::ByteView(record).first(end)) : 0;
    wire::store<wire::ByteOrder::little>(sum, record.data() + end);
}

std::vector<wire::Bytes> packets_of(wire::ByteView record, std::uint16_t transmission, std::uint32_t source,
                                    std::size_t most) {
    const std::size_t room = most - network_frame_size;
    NetworkFrame frame;
    frame.packets = static_cast<std::uint32_t>((record.size() + room - 1) / room);
    frame.transmission = transmission;
    frame.total_size = static_cast<std::uint32_t>(record.size());
    frame.source_device = source;
    std::vector<wire::Bytes> packets;
    for (std::size_t at = 0; at < record.size(); at += room, ++frame.sequence) {
        const auto part = record.subspan(at, std::min(room, record.size() - at));
        frame.packet_size = static_cast<std::uint32_t>(network_frame_size + part.size());
        wire::Bytes packet = wire::serialise(frame);
        packet.insert(packet.end(), part.begin(), part.end());
        packets.push_back(std::move(packet));
    }
    return packets;
}

Time7k to_time(double unix_time) {
    using namespace std::chrono;
    const auto whole = static_cast<std::int64_t>(std::floor(std::max(0.0, unix_time)));
    const sys_seconds seconds_since{seconds(whole)};
    const auto day = floor<days>(seconds_since);
    const year_month_day date(day);
    const auto new_year = sys_days(date.year() / January / 1);
    const std::int64_t left = (seconds_since - day).count();
    Time7k time;
    time.year = static_cast<std::uint16_t>(static_cast<int>(date.year()));
    time.day = static_cast<std::uint16_t>((day - new_year).count() + 1);
    time.hours = static_cast<std::uint8_t>(left / 3600);
    time.minutes = static_cast<std::uint8_t>(left / 60 % 60);
    const double fraction = std::max(0.0, unix_time) - static_cast<double>(whole);
    time.seconds = std::min(static_cast<float>(static_cast<double>(left % 60) + fraction), 59.999996F);
    return time;
}

std::string name_of(std::uint32_t type) { return find_name(type); }

}  // namespace echoloop::reson7k
