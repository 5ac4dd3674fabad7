#include "protocols/oculus/codec.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "protocols/oculus/layouts.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::oculus {
namespace {

constexpr std::size_t fire_payload = 37, fire_v2_payload = 73, user_config_payload = 12;
constexpr std::size_t result_payload = 106, result_v2_payload = 186;  // without bearings
constexpr std::size_t longest_text = 4096;
constexpr std::uint32_t usual_image_offset = 2048;  // of a real unit; bearings of 512 beams fit before it
constexpr double degree = std::numbers::pi / 180;

static_assert(wire::fixed_size<Header>() == header_bytes);
static_assert(wire::fixed_size<Fire>() == fire_payload && wire::fixed_size<FireV2>() == fire_v2_payload);
static_assert(wire::fixed_size<UserConfig>() == user_config_payload);
static_assert(wire::fixed_size<Status>() == status_payload);

/// Whether the sizes are those of such a message.
bool fits(const Header& h, std::size_t longest) {
    const std::size_t size = h.payload_size;
    const bool v2 = h.version == 2;
    if (size > longest || h.version > 2) return false;
    switch (h.id) {
        case Id::fire:
            return size == 0 || size == (v2 ? fire_v2_payload : fire_payload);
        case Id::result:
            return size >= (v2 ? result_v2_payload : result_payload) && size <= max_payload;
        case Id::full_result:
            return size >= fire_payload && size <= max_payload;
        case Id::user_config:
            return size == user_config_payload;
        case Id::log_text:
            return size <= longest_text;
        case Id::dummy:
            return size == 0;
        default:
            return size == status_payload;
    }
}

template <class M>
wire::Result<Message> parse_as(wire::ByteView payload) {
    auto message = wire::parse<M>(payload);
    if (!message) return message.error();
    return Message(*std::move(message));
}

Id id_of(const Message& message) {
    constexpr Id ids[] = {Id::fire,        Id::fire,     Id::result, Id::result, Id::full_result,
                          Id::user_config, Id::log_text, Id::dummy,  Id::status};
    static_assert(std::size(ids) == std::variant_size_v<Message>);
    return ids[message.index()];
}

bool is_v2(const Message& message) {
    return std::holds_alternative<FireV2>(message) || std::holds_alternative<ResultV2>(message);
}

template <class M>
wire::Bytes with_header(Header header, const M& message) {
    wire::Writer writer;
    wire::write_fields(writer, header);
    writer.counts.message(message);
    wire::write_fields(writer, message);
    wire::store<wire::ByteOrder::little>(static_cast<std::uint32_t>(writer.out.size() - header_bytes),
                                         writer.out.data() + 10);
    return std::move(writer.out);
}

const Fire& fire_of(const ResultV1& result) { return result.fire; }
const Fire& fire_of(const ResultV2& result) { return result.fire.fire; }

/// Bytes of the image that the result's other fields ask for.
template <class R>
Image image_form(const R& result, std::size_t beams) {
    Image image;
    image.sample_bytes = std::min<std::size_t>(static_cast<std::size_t>(result.data_size), 3) + 1;
    image.gain_words = (fire_of(result).flags & flag::gain_words) != 0;
    image.row_bytes = beams * image.sample_bytes + (image.gain_words ? 4 : 0);
    return image;
}

template <class R>
std::optional<Image> find_image(const R& result) {
    Image image = image_form(result, result.bearings.size());
    const std::size_t fixed = std::is_same_v<R, ResultV2> ? result_v2_payload : result_payload;
    const std::size_t tail_at = header_bytes + fixed + 2 * result.bearings.size();
    const std::size_t end = tail_at + result.tail.size();
    const std::size_t size = result.ranges * image.row_bytes;
    if (static_cast<unsigned>(result.data_size) > 3 || result.image_size != size) return std::nullopt;
    if (result.image_offset < tail_at || result.image_offset > end || end - result.image_offset < size)
        return std::nullopt;
    image.bytes = wire::ByteView(result.tail).subspan(result.image_offset - tail_at, size);
    return image;
}

template <class R>
wire::Bytes around_image(R& result, std::uint16_t source, std::uint16_t version) {
    const Image form = image_form(result, result.bearings.size());
    result.image_offset = usual_image_offset;
    result.image_size = static_cast<std::uint32_t>(result.ranges * form.row_bytes);
    result.message_size = result.image_offset + result.image_size;
    const Header header{source, 0, Id::result, version, 0, 0};
    wire::Writer writer;
    writer.out.reserve(result.message_size);
    wire::write_fields(writer, header);
    writer.counts.message(result);
    wire::write_fields(writer, result);
    writer.out.resize(result.message_size);
    wire::store<wire::ByteOrder::little>(static_cast<std::uint32_t>(result.message_size - header_bytes),
                                         writer.out.data() + 10);
    return std::move(writer.out);
}

}  // namespace

std::optional<Header> plausible_header(wire::ByteView bytes, std::size_t longest) {
    if (bytes.size() < header_bytes) return std::nullopt;
    const auto header = wire::parse<Header>(bytes.first(header_bytes));
    if (!header || !fits(*header, longest)) return std::nullopt;
    return *header;
}

std::size_t payload_bytes(const Header& header) {
    if (header.id != Id::fire || header.payload_size != 0) return header.payload_size;
    return header.version == 2 ? fire_v2_payload : fire_payload;
}

wire::Result<Message> parse(const Frame& frame) {
    const Header& h = frame.header;
    const bool v2 = h.version == 2;
    switch (h.id) {
        case Id::fire:
            return v2 ? parse_as<FireV2>(frame.payload) : parse_as<Fire>(frame.payload);
        case Id::result:
            return v2 ? parse_as<ResultV2>(frame.payload) : parse_as<ResultV1>(frame.payload);
        case Id::full_result:
            return parse_as<FullResult>(frame.payload);
        case Id::user_config:
            return parse_as<UserConfig>(frame.payload);
        case Id::log_text:
            return parse_as<LogText>(frame.payload);
        case Id::dummy:
            return parse_as<Dummy>(frame.payload);
        default:
            break;
    }
    if (frame.payload.size() == status_payload) return parse_as<Status>(frame.payload);
    return wire::Error{"Header", "id", 6, wire::Reason::unknown_message};
}

wire::Bytes encode(const Message& message, std::uint16_t source, std::uint16_t destination, Id id) {
    Header header{source, destination, id_of(message), 0, 0, 0};
    if (header.id == Id::status) header.id = id;
    if (is_v2(message)) header.version = 2;
    return std::visit([&](const auto& m) { return with_header(header, m); }, message);
}

wire::Bytes encode(const Frame& frame) {
    Header header = frame.header;
    header.payload_size = static_cast<std::uint32_t>(frame.payload.size());
    wire::Bytes out = wire::serialise(header);
    out.insert(out.end(), frame.payload.begin(), frame.payload.end());
    return out;
}

std::string name_of(const Frame& frame) {
    const auto raw = static_cast<unsigned>(frame.header.id);
    for (const wire::NamedValue& known : id_names) {
        if (known.value != raw) continue;
        const bool v2 =
            frame.header.version == 2 && (frame.header.id == Id::fire || frame.header.id == Id::result);
        return std::string(known.name) + (v2 ? "V2" : "");
    }
    if (frame.payload.size() == status_payload) return "Status";
    char text[24];
    std::snprintf(text, sizeof text, "message 0x%02x", raw);
    return text;
}

std::optional<Image> image_of(const ResultV1& result) { return find_image(result); }
std::optional<Image> image_of(const ResultV2& result) { return find_image(result); }

wire::Bytes encode_around_image(ResultV1& result, std::uint16_t source) {
    return around_image(result, source, 0);
}
wire::Bytes encode_around_image(ResultV2& result, std::uint16_t source) {
    return around_image(result, source, 2);
}

std::vector<double> bearings(std::size_t beams, double aperture) {
    const double edge = std::sin(aperture / 2);
    std::vector<double> out(beams);
    for (std::size_t i = 0; i < beams; ++i)
        out[i] = std::asin(edge * (2 * static_cast<double>(i) / static_cast<double>(beams - 1) - 1));
    return out;
}

std::int16_t wire_bearing(double radians) {
    // The last bit of an angle that is a whole number of hundredths must not cost a hundredth.
    constexpr double forgiven = 1e-9;
    const double hundredths = 100 * radians / degree;
    return static_cast<std::int16_t>(std::trunc(hundredths + std::copysign(forgiven, hundredths)));
}

}  // namespace echoloop::oculus
