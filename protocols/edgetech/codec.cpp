#include "protocols/edgetech/codec.h"

#include <algorithm>
#include <cmath>

#include "protocols/edgetech/layouts.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::edgetech {
namespace {

constexpr std::size_t sonar_data_head = 240, old_side_scan_head = 80;
constexpr std::uint8_t newest_version = 0x20;                      // MB-System knows 8 to 0xD
constexpr unsigned start_bits = 0, end_bits = 4, sample_bits = 8;  // of high_bits

static_assert(wire::fixed_size<PitchRoll>() == 44);

/// B that a body of this type has, or has before its data; 0: any.
std::size_t least_body(Type type) {
    switch (type) {
        case Type::system_time:
        case Type::file_time:
            return 8;
        case Type::shutdown:
        case Type::data_active:
        case Type::ping:
        case Type::ping_gain:
        case Type::trigger:
        case Type::range:
        case Type::pulse_select:
        case Type::gain_control:
            return 4;
        case Type::coupling:
            return 12;
        case Type::sonar_data:
            return sonar_data_head;
        case Type::old_side_scan:
            return old_side_scan_head;
        case Type::system_information:
            return 24;
        case Type::nmea_text:
            return 12;
        case Type::pitch_roll:
            return 44;
        case Type::pressure:
            return 32;
        default:
            return 0;
    }
}

template <class B>
wire::Result<Message> parse_as(const Header& header, wire::ByteView body) {
    auto parsed = wire::parse<B>(body);
    if (!parsed) return parsed.error();
    return Message{header, Body(*std::move(parsed))};
}

/// Of a setting, more bytes than it has would be lost.
bool has_exact_size(Type type) {
    const std::size_t size = least_body(type);
    return size > 0 && size <= 12 && type != Type::nmea_text;
}

unsigned nibble(const SonarData& data, unsigned shift) { return data.high_bits >> shift & 0xFU; }

void set_nibble(SonarData& data, unsigned shift, std::size_t value) {
    data.high_bits =
        static_cast<std::uint16_t>((data.high_bits & ~(0xFU << shift)) | (value & 0xFU) << shift);
}

std::size_t bytes_per_sample(DataFormat format) {
    switch (format) {
        case DataFormat::envelope:
        case DataFormat::raw:
        case DataFormat::real:
        case DataFormat::pixel:
            return 2;
        case DataFormat::analytic:
        case DataFormat::analytic_unmatched:
            return 4;
    }
    return 0;
}

/// Empty unless the bytes are `samples` of the format.
std::vector<float> levels_of(wire::ByteView data, DataFormat format, std::size_t samples, int weighting) {
    const std::size_t size = bytes_per_sample(format);
    if (size == 0 || data.size() % size != 0 || data.size() / size != samples) return {};
    const bool unsigned_ones = format == DataFormat::envelope || format == DataFormat::pixel;
    const auto number = [&](std::size_t at) {
        const auto raw = wire::load<wire::ByteOrder::little, std::uint16_t>(data.data() + at);
        return unsigned_ones ? static_cast<float>(raw) : static_cast<float>(static_cast<std::int16_t>(raw));
    };
    std::vector<float> out(samples);
    for (std::size_t i = 0; i < samples; ++i)
        out[i] = std::ldexp(
            size == 4 ? std::hypot(number(4 * i), number(4 * i + 2)) : std::abs(number(2 * i)), -weighting);
    return out;
}

}  // namespace

std::optional<Header> plausible_header(wire::ByteView bytes, std::size_t longest) {
    if (bytes.size() < header_bytes) return std::nullopt;
    const auto header = wire::parse<Header>(bytes.first(header_bytes));
    if (!header || header->version == 0 || header->version > newest_version) return std::nullopt;
    if (header->command > Command::error) return std::nullopt;
    return header->size <= longest - header_bytes ? std::optional(*header) : std::nullopt;
}

wire::Bytes encode(const Message& message) {
    wire::Bytes out = wire::serialise(message.header);
    const wire::Bytes body = std::visit([](const auto& b) { return wire::serialise(b); }, message.body);
    wire::store<wire::ByteOrder::little>(static_cast<std::uint32_t>(body.size()), out.data() + 12);
    out.insert(out.end(), body.begin(), body.end());
    return out;
}

wire::Result<Message> parse(wire::ByteView bytes) {
    const auto header = plausible_header(bytes);
    if (!header) return wire::Error{"Header", "type", 4, wire::Reason::unknown_message};
    if (bytes.size() != header_bytes + header->size)
        return wire::Error{"Header", "size", 12, wire::Reason::wrong_size};
    const wire::ByteView body = bytes.subspan(header_bytes);
    const std::size_t least = least_body(header->type);
    const bool fits = has_exact_size(header->type) ? body.size() == least : body.size() >= least;
    if (header->command == Command::get || !fits) return parse_as<Unread>(*header, body);
    switch (header->type) {
        case Type::system_time:
        case Type::file_time:
            return parse_as<SystemTime>(*header, body);
        case Type::shutdown:
        case Type::data_active:
        case Type::ping:
        case Type::ping_gain:
        case Type::trigger:
        case Type::range:
        case Type::pulse_select:
        case Type::gain_control:
            return parse_as<Setting>(*header, body);
        case Type::coupling:
            return parse_as<Coupling>(*header, body);
        case Type::sonar_data:
            return parse_as<SonarData>(*header, body);
        case Type::old_side_scan:
            return parse_as<OldSideScan>(*header, body);
        case Type::system_information:
            return parse_as<SystemInformation>(*header, body);
        case Type::nmea_text:
            return parse_as<NmeaText>(*header, body);
        case Type::pitch_roll:
            return body.size() == least ? parse_as<PitchRoll>(*header, body)
                                        : parse_as<Unread>(*header, body);
        case Type::pressure:
            return parse_as<Pressure>(*header, body);
        default:
            return parse_as<Unread>(*header, body);
    }
}

bool is_known(Type type) {
    return std::ranges::any_of(
        type_names, [&](const wire::NamedValue& v) { return v.value == static_cast<std::uint16_t>(type); });
}

std::string name_of(const Header& header) {
    for (const wire::NamedValue& known : type_names)
        if (known.value == static_cast<std::uint16_t>(header.type)) return std::string(known.name);
    return "message " + std::to_string(static_cast<unsigned>(header.type));
}

std::size_t sample_count(const SonarData& data) {
    return data.samples | std::size_t{nibble(data, sample_bits)} << 16;
}

void set_sample_count(SonarData& data, std::size_t count) {
    data.samples = static_cast<std::uint16_t>(count);
    set_nibble(data, sample_bits, count >> 16);
}

double start_frequency(const SonarData& data) {
    return 10.0 * (data.start_frequency | nibble(data, start_bits) << 16);
}
double end_frequency(const SonarData& data) {
    return 10.0 * (data.end_frequency | nibble(data, end_bits) << 16);
}

void set_frequencies(SonarData& data, double start, double end) {
    const auto tens = [](double hertz) { return static_cast<std::size_t>(std::lround(hertz / 10)); };
    data.start_frequency = static_cast<std::uint16_t>(tens(start));
    data.end_frequency = static_cast<std::uint16_t>(tens(end));
    set_nibble(data, start_bits, tens(start) >> 16);
    set_nibble(data, end_bits, tens(end) >> 16);
}

std::vector<float> levels(const SonarData& data) {
    return levels_of(data.data, data.format, sample_count(data), data.weighting);
}

std::vector<float> levels(const OldSideScan& data) {
    return levels_of(data.data, static_cast<DataFormat>(data.format), data.samples, data.weighting);
}

wire::Found<wire::Bytes> MessageFinder::find(wire::ByteView pending, bool finished) const {
    const wire::Found<wire::Bytes> noise{wire::bytes_before(0x01, pending)};
    const auto header = plausible_header(pending, longest_);
    if (!header) {
        const bool may_begin = pending[0] == 0x01 && (pending.size() < 2 || pending[1] == 0x16);
        return may_begin && pending.size() < header_bytes && !finished ? wire::Found<wire::Bytes>{} : noise;
    }
    const std::size_t size = header_bytes + header->size;
    if (pending.size() < size) return finished ? noise : wire::Found<wire::Bytes>{};
    return {0, size, wire::Bytes(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(size))};
}

}  // namespace echoloop::edgetech
