// The field tables of the Ping frame and of all messages. Tables only. Payload layouts start at byte 8 of the
// frame.
#pragma once

#include "protocols/ping/messages.h"
#include "protocols/ping/names.h"
#include "protocols/wire/layout.h"

namespace echoloop::ping {

using namespace wire;

constexpr Heading payload_of(std::string_view name, std::string_view help) {
    return {name, help, ByteOrder::little, 8};
}

constexpr auto wire_layout(Tag<Header>) {
    return make_layout<Header>({"Header", "id and devices", ByteOrder::little, 4},
                               field(&Header::id, "id", "", "message id"),
                               field(&Header::source, "source", "", "0 host, else id of the device"),
                               field(&Header::destination, "destination", "", "0 from most hosts"));
}

constexpr auto wire_layout(Tag<Frame>) {
    return make_layout<Frame>({"Frame", "one frame from 'B' to the checksum"},
                              magic("BR", "start", "always BR"),
                              count<std::uint16_t>("payload", 0, "payload_length", "B", "bytes of payload"),
                              field(&Frame::header, "header", "", "bytes 4 to 7"),
                              counted(&Frame::payload, "payload", "payload", "", "the message"),
                              field(&Frame::checksum, "checksum", "", "sum of all bytes before it").hex());
}

constexpr auto wire_layout(Tag<Ack>) {
    return make_layout<Ack>(payload_of("Ack", "the message was obeyed"),
                            field(&Ack::acked_id, "acked_id", "", "id of that message"));
}
constexpr auto wire_layout(Tag<Nack>) {
    return make_layout<Nack>(payload_of("Nack", "the message was refused"),
                             field(&Nack::nacked_id, "nacked_id", "", "id of that message"),
                             rest(&Nack::text, {}, "text", "", "why; not always terminated"));
}
constexpr auto wire_layout(Tag<AsciiText>) {
    return make_layout<AsciiText>(payload_of("AsciiText", "text for people"),
                                  rest(&AsciiText::text, {}, "text", "", ""));
}
constexpr auto wire_layout(Tag<DeviceInformation>) {
    return make_layout<DeviceInformation>(
        payload_of("DeviceInformation", "what is at the other end"),
        field(&DeviceInformation::device_type, "device_type", "", "0 unknown, 1 Ping1D, 2 Ping360"),
        field(&DeviceInformation::device_revision, "device_revision", "", "hardware"),
        field(&DeviceInformation::firmware_major, "firmware_major", "", ""),
        field(&DeviceInformation::firmware_minor, "firmware_minor", "", ""),
        field(&DeviceInformation::firmware_patch, "firmware_patch", "", ""),
        field(&DeviceInformation::reserved, "reserved", "", "0"));
}
constexpr auto wire_layout(Tag<ProtocolVersion>) {
    return make_layout<ProtocolVersion>(payload_of("ProtocolVersion", "version of the message set"),
                                        field(&ProtocolVersion::major, "major", "", ""),
                                        field(&ProtocolVersion::minor, "minor", "", ""),
                                        field(&ProtocolVersion::patch, "patch", "", ""),
                                        field(&ProtocolVersion::reserved, "reserved", "", "0"));
}
constexpr auto wire_layout(Tag<GeneralRequest>) {
    return make_layout<GeneralRequest>(
        payload_of("GeneralRequest", "asks for a message"),
        field(&GeneralRequest::requested_id, "requested_id", "", "id of that message"));
}
constexpr auto wire_layout(Tag<SetDeviceId>) {
    return make_layout<SetDeviceId>(payload_of("SetDeviceId", "new id of any device"),
                                    field(&SetDeviceId::device_id, "device_id", "", "1 to 254"));
}

}  // namespace echoloop::ping
