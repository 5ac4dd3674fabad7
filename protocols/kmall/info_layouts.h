// The field tables of #IIP, #IOP and #SVP. Tables only; offsets count from the start of each struct.
#pragma once

#include "protocols/kmall/info_parts.h"
#include "protocols/kmall/layouts.h"

namespace echoloop::kmall {

constexpr auto wire_layout(Tag<ParametersInfo>) {
    return make_layout<ParametersInfo>(
        part_of("ParametersInfo", "#IIP, #IOP: begins it; the text follows"),
        field(&ParametersInfo::size, "size", "B", "of this struct and the text"),
        field(&ParametersInfo::info, "info", "", "for later use"),
        field(&ParametersInfo::status, "status", "", "for later use"));
}
constexpr auto wire_layout(Tag<SoundProfileInfo>) {
    return make_layout<SoundProfileInfo>(
        part_of("SoundProfileInfo", "#SVP: begins it; the points follow"),
        field(&SoundProfileInfo::size, "size", "B", "of this struct, 28"),
        field(&SoundProfileInfo::points, "points", "", "number of them"),
        field(&SoundProfileInfo::format, "format", "", "S00 sound speed, S01 CTD"),
        field(&SoundProfileInfo::seconds, "seconds", "s", "Unix time of the measurement; 0: not known"),
        field(&SoundProfileInfo::latitude, "latitude", "deg", "200: not known"),
        field(&SoundProfileInfo::longitude, "longitude", "deg", "200: not known"));
}
constexpr auto wire_layout(Tag<SoundProfilePoint>) {
    return make_layout<SoundProfilePoint>(part_of("SoundProfilePoint", "#SVP: the water at a depth"),
                                          field(&SoundProfilePoint::depth, "depth", "m", "below the surface"),
                                          field(&SoundProfilePoint::sound_speed, "sound_speed", "m/s", ""),
                                          field(&SoundProfilePoint::padding, "padding", "", ""),
                                          field(&SoundProfilePoint::temperature, "temperature", "deg C", ""),
                                          field(&SoundProfilePoint::salinity, "salinity", "PSU", ""));
}

}  // namespace echoloop::kmall
