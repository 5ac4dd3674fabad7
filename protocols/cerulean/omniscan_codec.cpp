#include "protocols/cerulean/omniscan_codec.h"

#include "protocols/cerulean/codec_rows.h"
#include "protocols/cerulean/omniscan_layouts.h"

namespace echoloop::cerulean::omniscan {
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
    {Id::general_speed_of_sound, parse_as<Message, GeneralSpeedOfSound>},
    {Id::os_ping_params, parse_as<Message, OsPingParams>},
    {Id::os_mono_profile, parse_as<Message, OsMonoProfile>},
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

std::vector<wire::Table> tables() { return {table_of<OsPingParams>(), table_of<OsMonoProfile>()}; }

}  // namespace echoloop::cerulean::omniscan
