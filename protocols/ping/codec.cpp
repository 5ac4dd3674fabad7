#include "protocols/ping/codec.h"

#include <algorithm>
#include <numeric>

#include "protocols/ping/ping1d_layouts.h"
#include "protocols/ping/ping360_layouts.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"

namespace echoloop::ping {
namespace {

template <class M>
Result<Message> parse_as(ByteView payload) {
    auto message = wire::parse<M>(payload);
    if (!message) return message.error();
    return Message(*std::move(message));
}

/// The table of messages: one row per alternative of Message, in its order.
struct Row {
    Id id;
    Result<Message> (*parse)(ByteView);
};
constexpr Row rows[] = {
    {Id::ack, parse_as<Ack>},
    {Id::nack, parse_as<Nack>},
    {Id::ascii_text, parse_as<AsciiText>},
    {Id::device_information, parse_as<DeviceInformation>},
    {Id::protocol_version, parse_as<ProtocolVersion>},
    {Id::general_request, parse_as<GeneralRequest>},
    {Id::set_device_id, parse_as<SetDeviceId>},
    {Id::ping1d_set_device_id, parse_as<Ping1dSetDeviceId>},
    {Id::set_range, parse_as<SetRange>},
    {Id::set_speed_of_sound, parse_as<SetSpeedOfSound>},
    {Id::set_mode_auto, parse_as<SetModeAuto>},
    {Id::set_ping_interval, parse_as<SetPingInterval>},
    {Id::set_gain_setting, parse_as<SetGainSetting>},
    {Id::set_ping_enable, parse_as<SetPingEnable>},
    {Id::set_oss_profile_configuration, parse_as<SetOssProfileConfiguration>},
    {Id::goto_bootloader, parse_as<GotoBootloader>},
    {Id::firmware_version, parse_as<FirmwareVersion>},
    {Id::device_id, parse_as<DeviceId>},
    {Id::voltage5, parse_as<Voltage5>},
    {Id::speed_of_sound, parse_as<SpeedOfSound>},
    {Id::range, parse_as<Range>},
    {Id::mode_auto, parse_as<ModeAuto>},
    {Id::ping_interval, parse_as<PingInterval>},
    {Id::gain_setting, parse_as<GainSetting>},
    {Id::transmit_duration, parse_as<TransmitDuration>},
    {Id::general_info, parse_as<GeneralInfo>},
    {Id::distance_simple, parse_as<DistanceSimple>},
    {Id::distance, parse_as<Distance>},
    {Id::processor_temperature, parse_as<ProcessorTemperature>},
    {Id::pcb_temperature, parse_as<PcbTemperature>},
    {Id::ping_enable, parse_as<PingEnable>},
    {Id::profile, parse_as<Profile>},
    {Id::oss_profile_configuration, parse_as<OssProfileConfiguration>},
    {Id::continuous_start, parse_as<ContinuousStart>},
    {Id::continuous_stop, parse_as<ContinuousStop>},
    {Id::ping360_set_device_id, parse_as<Ping360SetDeviceId>},
    {Id::device_data, parse_as<DeviceData>},
    {Id::auto_device_data, parse_as<AutoDeviceData>},
    {Id::reset, parse_as<Reset>},
    {Id::transducer, parse_as<Transducer>},
    {Id::auto_transmit, parse_as<AutoTransmit>},
    {Id::motor_off, parse_as<MotorOff>},
};
static_assert(std::size(rows) == std::variant_size_v<Message>);

const Row* find_row(Id id) {
    const auto* row =
        std::find_if(std::begin(rows), std::end(rows), [&](const Row& r) { return r.id == id; });
    return row == std::end(rows) ? nullptr : row;
}

Frame with_checksum(Frame frame) {
    frame.checksum = checksum(encode(frame));
    return frame;
}

}  // namespace

wire::Result<Message> parse(const Frame& frame) {
    const Row* row = find_row(frame.header.id);
    if (row == nullptr) return Error{"Frame", "id", 4, Reason::unknown_message};
    return row->parse(frame.payload);
}

bool is_short_request(const Frame& frame) {
    const Row* row = find_row(frame.header.id);
    return frame.payload.empty() && row != nullptr && !row->parse({}).has_value();
}

Frame make_frame(const Message& message, std::uint8_t source, std::uint8_t destination) {
    Frame frame{{id_of(message), source, destination}, {}, 0};
    frame.payload = std::visit([](const auto& m) { return wire::serialise(m); }, message);
    return with_checksum(std::move(frame));
}

Frame short_request(Id id) { return with_checksum({{id, 0, 0}, {}, 0}); }

wire::Bytes encode(const Frame& frame) { return wire::serialise(frame); }

wire::Bytes encode(const Message& message, std::uint8_t source, std::uint8_t destination) {
    return encode(make_frame(message, source, destination));
}

std::uint16_t checksum(wire::ByteView bytes) {
    if (bytes.size() < 2) return 0;
    return static_cast<std::uint16_t>(std::accumulate(bytes.begin(), bytes.end() - 2, 0U));
}

Id id_of(const Message& message) { return rows[message.index()].id; }

std::string name_of(Id id) {
    const auto* row = std::find_if(std::begin(id_names), std::end(id_names), [&](const NamedValue& name) {
        return name.value == static_cast<std::uint16_t>(id);
    });
    if (row != std::end(id_names)) return std::string(row->name);
    return "id " + std::to_string(static_cast<int>(id));
}

}  // namespace echoloop::ping
