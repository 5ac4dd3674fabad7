// The field tables of the Oculus messages. Tables only. Payload layouts start at byte 16 of the message.
#pragma once

#include "protocols/oculus/messages.h"
#include "protocols/oculus/names.h"
#include "protocols/wire/layout.h"

namespace echoloop::oculus {

using namespace wire;

inline constexpr std::size_t header_bytes = 16;

constexpr Heading payload_of(std::string_view name, std::string_view help) {
    return {name, help, ByteOrder::little, header_bytes};
}

constexpr auto wire_layout(Tag<Header>) {
    return make_layout<Header>({"Header", "before every message"}, magic("SO", "start", "always SO"),
                               field(&Header::source, "source", "", "the sonar's id; 0 from a host"),
                               field(&Header::destination, "destination", "", "ignored").hex(),
                               field(&Header::id, "id", "", "what follows; of a Status not known"),
                               field(&Header::version, "version", "", "0 or 1; v2 messages 2"),
                               field(&Header::payload_size, "payload_size", "B",
                                     "behind this header; 0 in a Fire counts as all of it"),
                               field(&Header::spare, "spare", "", "0; a part number in newer ones"));
}

constexpr auto wire_layout(Tag<Fire>) {
    return make_layout<Fire>(
        payload_of("Fire", "a host's settings; pings follow until the next one"),
        field(&Fire::mode, "mode", "", ""), field(&Fire::rate, "rate", "", "the most pings a second"),
        field(&Fire::network_speed, "network_speed", "Mbit/s", "limit; 0 and 255: as fast as the link"),
        field(&Fire::gamma, "gamma", "", "127 is 0.5; 255 and 0 are 1"),
        field(&Fire::flags, "flags", "", "").bits(flag_names),
        field(&Fire::range, "range", "m or %", "as bit 0 of the flags says"),
        field(&Fire::gain, "gain", "%", "real units may return 40 + 0.6 gain in mode 2"),
        field(&Fire::sound_speed, "sound_speed", "m/s", "0: from temperature and salinity"),
        field(&Fire::salinity, "salinity", "ppt", "0: fresh water"));
}

constexpr auto wire_layout(Tag<FireV2>) {
    return make_layout<FireV2>(payload_of("FireV2", "version 2 of Fire"),
                               field(&FireV2::fire, "fire", "", "as version 1"),
                               field(&FireV2::ext_flags, "ext_flags", "", "").bits(ext_flag_names),
                               field(&FireV2::reserved, "reserved", "", ""));
}

constexpr auto wire_layout(Tag<ResultV1>) {
    return make_layout<ResultV1>(
        payload_of("Result", "one ping: answer to Fire"),
        field(&ResultV1::fire, "fire", "", "echo, with effective values"),
        field(&ResultV1::ping_id, "ping_id", "", "1 more each ping"),
        field(&ResultV1::status, "status", "", "").hex(), field(&ResultV1::frequency, "frequency", "Hz", ""),
        field(&ResultV1::temperature, "temperature", "degC", "nonsense on real units"),
        field(&ResultV1::pressure, "pressure", "bar", "nonsense on real units"),
        field(&ResultV1::sound_speed, "sound_speed", "m/s", "the one used"),
        field(&ResultV1::start_time, "start_time", "ns", "of the ping; wraps"),
        field(&ResultV1::data_size, "data_size", "", "of a sample"),
        field(&ResultV1::range_resolution, "range_resolution", "m", "per row"),
        field(&ResultV1::ranges, "ranges", "", "rows, nearest first"),
        count(&ResultV1::beams, "beams", "beams", "", "columns"),
        field(&ResultV1::image_offset, "image_offset", "B", "from the header's first byte"),
        field(&ResultV1::image_size, "image_size", "B", "ranges x (beams x bytes, 4 more with gain words)"),
        field(&ResultV1::message_size, "message_size", "B", "with the header"),
        counted(&ResultV1::bearings, "beams", "bearings", "0.01 deg", "ascending, in equal steps of sine"),
        rest(&ResultV1::tail, {}, "tail", "", "a gap, then the image from image_offset on"));
}

constexpr auto wire_layout(Tag<ResultV2>) {
    return make_layout<ResultV2>(
        payload_of("ResultV2", "one ping: answer to FireV2"),
        field(&ResultV2::fire, "fire", "", "echo, with effective values"),
        field(&ResultV2::ping_id, "ping_id", "", "1 more each ping"),
        field(&ResultV2::status, "status", "", "").hex(), field(&ResultV2::frequency, "frequency", "Hz", ""),
        field(&ResultV2::temperature, "temperature", "degC", ""),
        field(&ResultV2::pressure, "pressure", "bar", ""), field(&ResultV2::heading, "heading", "deg", ""),
        field(&ResultV2::pitch, "pitch", "deg", ""), field(&ResultV2::roll, "roll", "deg", ""),
        field(&ResultV2::sound_speed, "sound_speed", "m/s", "the one used"),
        field(&ResultV2::start_time, "start_time", "s", "of the ping, since power-up"),
        field(&ResultV2::data_size, "data_size", "", "of a sample"),
        field(&ResultV2::range_resolution, "range_resolution", "m", "per row"),
        field(&ResultV2::ranges, "ranges", "", "rows, nearest first"),
        count(&ResultV2::beams, "beams", "beams", "", "columns"), field(&ResultV2::spare, "spare", "", ""),
        field(&ResultV2::image_offset, "image_offset", "B", "from the header's first byte"),
        field(&ResultV2::image_size, "image_size", "B", "ranges x (beams x bytes, 4 more with gain words)"),
        field(&ResultV2::message_size, "message_size", "B", "with the header"),
        counted(&ResultV2::bearings, "beams", "bearings", "0.01 deg", "ascending, in equal steps of sine"),
        rest(&ResultV2::tail, {}, "tail", "", "a gap, then the image from image_offset on"));
}

constexpr auto wire_layout(Tag<FullResult>) {
    return make_layout<FullResult>(
        payload_of("FullResult", "answer where flag bit 3 is clear; not documented"),
        rest(&FullResult::bytes, {}, "bytes", "", "not documented"));
}
constexpr auto wire_layout(Tag<UserConfig>) {
    return make_layout<UserConfig>(payload_of("UserConfig", "address of the sonar"),
                                   field(&UserConfig::ip, "ip", "", "first number first"),
                                   field(&UserConfig::mask, "mask", "", ""),
                                   field(&UserConfig::dhcp, "dhcp", "", "1: on"));
}
constexpr auto wire_layout(Tag<LogText>) {
    return make_layout<LogText>(payload_of("LogText", "a line for people"),
                                rest(&LogText::text, {}, "text", "", "ASCII"));
}
constexpr auto wire_layout(Tag<Dummy>) {
    return make_layout<Dummy>(payload_of("Dummy", "once a second in standby"));
}
constexpr auto wire_layout(Tag<Version>) {
    return make_layout<Version>(
        {"Version", "of a part of the firmware"},
        field(&Version::version, "version", "", "major 8 bits, minor 8, build 16").hex(),
        field(&Version::date, "date", "", "").hex());
}

constexpr auto wire_layout(Tag<Status>) {
    return make_layout<Status>(
        payload_of("Status", "UDP broadcast by which a sonar is found; 142 bytes with the header"),
        field(&Status::device_id, "device_id", "", "the header's source"),
        field(&Status::device_type, "device_type", "", "1: imaging sonar"),
        field(&Status::part_number, "part_number", "", "names the model"),
        field(&Status::bits, "bits", "", "bits 0-2 state, 3: main program; 3-5 reason of a pause")
            .bits(status_bit_names),
        field(&Status::firmware0, "firmware0", "", ""), field(&Status::firmware1, "firmware1", "", ""),
        field(&Status::bit_file, "bit_file", "", ""),
        field(&Status::ip, "ip", "", "where to connect to; first number first"),
        field(&Status::mask, "mask", "", ""),
        field(&Status::client_ip, "client_ip", "", "who is connected; zeros: nobody"),
        field(&Status::mac, "mac", "", ""), field(&Status::temperatures, "temperatures", "degC", ""),
        field(&Status::pressure, "pressure", "bar", ""));
}

}  // namespace echoloop::oculus
