#include "protocols/ping/inspect.h"

#include "protocols/inspect_stream.h"
#include "protocols/ping/codec.h"
#include "protocols/ping/framer.h"
#include "protocols/ping/ping1d_layouts.h"
#include "protocols/ping/ping360_layouts.h"

namespace echoloop::ping {
namespace {

using inspect::add_fields;

inspect::Message inspected(const Frame& frame, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size, .name = name_of(frame.header.id)};
    add_fields(out, frame.header);
    if (is_short_request(frame)) {
        out.name += " request";
    } else if (const auto message = parse(frame)) {
        std::visit([&](const auto& m) { add_fields(out, m); }, *message);
    } else {
        out.reason = message.error().what();
    }
    return out;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

bool recognise(wire::ByteView bytes) { return inspect::recognise_stream<Framer>(bytes); }

std::vector<wire::Table> tables() {
    using wire::table_of;
    return {table_of<Frame>(),
            table_of<Header>(),
            table_of<Ack>(),
            table_of<Nack>(),
            table_of<AsciiText>(),
            table_of<DeviceInformation>(),
            table_of<ProtocolVersion>(),
            table_of<GeneralRequest>(),
            table_of<SetDeviceId>(),
            table_of<Ping1dSetDeviceId>(),
            table_of<SetRange>(),
            table_of<SetSpeedOfSound>(),
            table_of<SetModeAuto>(),
            table_of<SetPingInterval>(),
            table_of<SetGainSetting>(),
            table_of<SetPingEnable>(),
            table_of<SetOssProfileConfiguration>(),
            table_of<GotoBootloader>(),
            table_of<FirmwareVersion>(),
            table_of<DeviceId>(),
            table_of<Voltage5>(),
            table_of<SpeedOfSound>(),
            table_of<Range>(),
            table_of<ModeAuto>(),
            table_of<PingInterval>(),
            table_of<GainSetting>(),
            table_of<TransmitDuration>(),
            table_of<GeneralInfo>(),
            table_of<DistanceSimple>(),
            table_of<Distance>(),
            table_of<ProcessorTemperature>(),
            table_of<PcbTemperature>(),
            table_of<PingEnable>(),
            table_of<Profile>(),
            table_of<OssProfileConfiguration>(),
            table_of<ContinuousStart>(),
            table_of<ContinuousStop>(),
            table_of<Ping360SetDeviceId>(),
            table_of<DeviceData>(),
            table_of<AutoDeviceData>(),
            table_of<Reset>(),
            table_of<Transducer>(),
            table_of<AutoTransmit>(),
            table_of<MotorOff>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    return inspect::rewritten_frame<Framer>(bytes, [](const Frame& frame) -> wire::Bytes {
        const auto message = parse(frame);
        return message ? encode(*message, frame.header.source) : wire::Bytes{};
    });
}

std::vector<ChecksumPlace> checksums(wire::ByteView bytes) {
    constexpr std::size_t sum_bytes = 2;
    Framer framer;
    framer.feed(bytes);
    std::vector<ChecksumPlace> places;
    while (const auto frame = framer.next()) {
        const std::size_t size = min_frame_bytes + frame->payload.size();
        places.push_back({framer.frame_offset() + size - sum_bytes, sum_bytes});
    }
    return places;
}

}  // namespace echoloop::ping
