// The field tables of what all Cerulean sonars have in common. Tables only. Payload layouts start at byte 8
// of the frame.
#pragma once

#include "protocols/cerulean/messages.h"
#include "protocols/ping/layouts.h"

namespace echoloop::cerulean {

using namespace wire;
using ping::payload_of;

constexpr auto wire_layout(Tag<Header>) {
    return make_layout<Header>(
        {"Header", "id and devices, in a frame of the Ping protocol", ByteOrder::little, 4},
        field(&Header::id, "id", "", "message id"),
        field(&Header::source, "source", "", "0 host, else id of the device"),
        field(&Header::destination, "destination", "", "0 from most hosts"));
}
constexpr auto wire_layout(Tag<JsonWrapper>) {
    return make_layout<JsonWrapper>(payload_of("JsonWrapper", "first message of a .svlog file"),
                                    rest(&JsonWrapper::text, {}, "text", "", "JSON in UTF-8"));
}
constexpr auto wire_layout(Tag<SetSpeedOfSound>) {
    return make_layout<SetSpeedOfSound>(
        payload_of("SetSpeedOfSound", "for distances; the id of older definitions and of the S500"),
        field(&SetSpeedOfSound::speed_of_sound, "speed_of_sound", "mm/s", ""));
}
constexpr auto wire_layout(Tag<GeneralSpeedOfSound>) {
    return make_layout<GeneralSpeedOfSound>(
        payload_of("GeneralSpeedOfSound", "the same under the id of the newest definitions"),
        field(&GeneralSpeedOfSound::speed_of_sound, "speed_of_sound", "mm/s", ""));
}

}  // namespace echoloop::cerulean
