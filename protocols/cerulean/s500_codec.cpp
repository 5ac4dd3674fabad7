#include "protocols/cerulean/s500_codec.h"

#include "protocols/cerulean/codec_rows.h"
#include "protocols/cerulean/s500_layouts.h"

namespace echoloop::cerulean::s500 {
namespace {

constexpr Row<Message> table[] = {
    {Id::ack, parse_as<Message, ping::Ack>},
    {Id::nack, parse_as<Message, ping::Nack>},
    {Id::ascii_text, parse_as<Message, ping::AsciiText>},
    {Id::device_information, parse_as<Message, ping::DeviceInformation>},
    {Id::protocol_version, parse_as<Message, ping::ProtocolVersion>},
    {Id::general_request, parse_as<Message, ping::GeneralRequest>},
    {Id::json_wrapper, parse_as<Message, JsonWrapper>},
    {Id::set_speed_of_sound, parse_as<Message, SetSpeedOfSound>},
    {Id::s500_ping_params, parse_as<Message, SetPingParams>},
    {Id::fw_version, parse_as<Message, FwVersion>},
    {Id::speed_of_sound, parse_as<Message, SpeedOfSound>},
    {Id::range, parse_as<Message, Range>},
    {Id::ping_rate, parse_as<Message, PingRate>},
    {Id::gain_index, parse_as<Message, GainIndex>},
    {Id::altitude, parse_as<Message, Altitude>},
    {Id::processor_temperature, parse_as<Message, ProcessorTemperature>},
    {Id::distance2, parse_as<Message, Distance2>},
    {Id::profile6, parse_as<Message, Profile6>},
};
static_assert(std::size(table) == std::variant_size_v<Message>);
constexpr std::span<const Row<Message>> rows(table);

}  // namespace

wire::Result<Message> parse(const ping::Frame& frame) { return parse_by(rows, frame); }

bool is_short_request(const ping::Frame& frame) { return is_short_request_by(rows, frame); }

wire::Bytes encode(const Message& message, std::uint8_t source, std::uint8_t destination) {
    return encode_by(rows, message, source, destination);
}

bool add_fields(const ping::Frame& frame, inspect::Message& out) { return inspect_by(rows, frame, out); }

std::vector<wire::Table> tables() {
    return {table_of<SetPingParams>(), table_of<FwVersion>(), table_of<SpeedOfSound>(),
            table_of<Range>(),         table_of<PingRate>(),  table_of<GainIndex>(),
            table_of<Altitude>(),      table_of<Distance2>(), table_of<ProcessorTemperature>(),
            table_of<Profile6>()};
}

}  // namespace echoloop::cerulean::s500
