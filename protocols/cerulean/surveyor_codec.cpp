#include "protocols/cerulean/surveyor_codec.h"

#include "protocols/cerulean/codec_rows.h"
#include "protocols/cerulean/surveyor_layouts.h"

namespace echoloop::cerulean::surveyor {
namespace {

constexpr Row<Message> table[] = {
    {Id::ack, parse_as<Message, ping::Ack>},
    {Id::nack, parse_as<Message, ping::Nack>},
    {Id::ascii_text, parse_as<Message, ping::AsciiText>},
    {Id::device_information, parse_as<Message, ping::DeviceInformation>},
    {Id::protocol_version, parse_as<Message, ping::ProtocolVersion>},
    {Id::general_request, parse_as<Message, ping::GeneralRequest>},
    {Id::json_wrapper, parse_as<Message, JsonWrapper>},
    {Id::utc_request, parse_as<Message, UtcRequest>},
    {Id::utc_response, parse_as<Message, UtcResponse>},
    {Id::set_net_info, parse_as<Message, SetNetInfo>},
    {Id::water_stats, parse_as<Message, WaterStats>},
    {Id::attitude_report, parse_as<Message, AttitudeReport>},
    {Id::yz_point_data, parse_as<Message, YzPointData>},
    {Id::atof_point_data, parse_as<Message, AtofPointData>},
    {Id::surveyor_ping_parameters, parse_as<Message, PingParameters>},
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
    using wire::table_of;
    return {table_of<UtcRequest>(),     table_of<UtcResponse>(), table_of<SetNetInfo>(),
            table_of<WaterStats>(),     table_of<YzPoint>(),     table_of<AtofPoint>(),
            table_of<AttitudeReport>(), table_of<YzPointData>(), table_of<AtofPointData>(),
            table_of<PingParameters>()};
}

}  // namespace echoloop::cerulean::surveyor
