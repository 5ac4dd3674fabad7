#include "protocols/cerulean/inspect.h"

#include <algorithm>

#include "protocols/cerulean/layouts.h"
#include "protocols/cerulean/omniscan_codec.h"
#include "protocols/cerulean/s500_codec.h"
#include "protocols/cerulean/surveyor_codec.h"
#include "protocols/inspect_stream.h"
#include "protocols/ping/framer.h"

namespace echoloop::cerulean {
namespace {

/// One per device, each with messages of its own; what all have in common any of them can read.
constexpr bool (*devices[])(const ping::Frame&, inspect::Message&) = {
    omniscan::Codec::add_fields,
    s500::Codec::add_fields,
    surveyor::Codec::add_fields,
};

std::string name_of(ping::Id id) {
    const auto number = static_cast<std::uint16_t>(id);
    for (const wire::NamedValue& known : id_names)
        if (known.value == number) return std::string(known.name);
    return "id " + std::to_string(number);
}

/// Words instead of numbers; bytes that are none become dots.
void show_text(const ping::Frame& frame, inspect::Message& out) {
    if (static_cast<Id>(frame.header.id) != Id::json_wrapper) return;
    inspect::Field& field = out.fields.back();
    field.numbers.clear();
    field.text.clear();
    for (const std::uint8_t c : frame.payload)
        field.text += c == '\n' ? ' ' : c >= ' ' && c < 127 ? static_cast<char>(c) : '.';
}

inspect::Message inspected(const ping::Frame& frame, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size, .name = name_of(frame.header.id)};
    const auto& header = frame.header;
    inspect::add_fields(out, Header{static_cast<Id>(header.id), header.source, header.destination});
    const bool known = std::any_of(std::begin(devices), std::end(devices),
                                   [&](const auto add_fields) { return add_fields(frame, out); });
    if (!known) out.reason = Error{"Frame", "id", 4, Reason::unknown_message}.what();
    show_text(frame, out);
    return out;
}

/// Ids that neither the common messages nor a Ping1D or Ping360 have, and the one that both have in different
/// lengths.
bool is_own(const ping::Frame& frame) {
    constexpr Id own[] = {Id::json_wrapper,
                          Id::utc_request,
                          Id::utc_response,
                          Id::set_net_info,
                          Id::water_stats,
                          Id::attitude_report,
                          Id::s500_ping_params,
                          Id::distance2,
                          Id::profile6,
                          Id::os_ping_params,
                          Id::os_mono_profile,
                          Id::yz_point_data,
                          Id::atof_point_data,
                          Id::surveyor_ping_parameters,
                          Id::general_speed_of_sound,
                          Id::processor_temperature};
    const auto id = static_cast<Id>(frame.header.id);
    if (std::find(std::begin(own), std::end(own), id) == std::end(own)) return false;
    const bool too_short = id == Id::processor_temperature && frame.payload.size() != 4;
    return !too_short && inspected(frame, 0, 0).reason.empty();
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<ping::Framer>(bytes, inspected);
}

bool recognise(wire::ByteView bytes) {
    ping::Framer framer;
    const auto found = [&] {
        while (const auto frame = framer.next())
            if (is_own(*frame)) return true;
        return false;
    };
    for (std::size_t from = 0; from < bytes.size(); from += inspect::stream_chunk) {
        framer.feed(bytes.subspan(from, std::min(inspect::stream_chunk, bytes.size() - from)));
        if (found()) return true;
    }
    framer.finish();
    return found();
}

std::vector<wire::Table> tables() {
    std::vector<wire::Table> all{table_of<Header>(), table_of<JsonWrapper>(), table_of<SetSpeedOfSound>(),
                                 table_of<GeneralSpeedOfSound>()};
    for (auto more : {omniscan::tables(), s500::tables(), surveyor::tables()})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

wire::Bytes rewritten(wire::ByteView bytes) {
    ping::Framer framer;
    framer.feed(bytes);
    const auto frame = framer.next();
    if (!frame) return {};
    const std::uint8_t from = frame->header.source, to = frame->header.destination;
    if (const auto message = omniscan::Codec::parse(*frame))
        return omniscan::Codec::encode(*message, from, to);
    if (const auto message = s500::Codec::parse(*frame)) return s500::Codec::encode(*message, from, to);
    if (const auto message = surveyor::Codec::parse(*frame))
        return surveyor::Codec::encode(*message, from, to);
    return {};
}

}  // namespace echoloop::cerulean
