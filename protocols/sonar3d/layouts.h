// The fields of the Sonar 3D-15's protobuf messages: number, member, name, unit and meaning. Tables only;
// what is done with them is in protobuf.h and inspect.cpp.
#pragma once

#include <string_view>
#include <tuple>

#include "protocols/sonar3d/messages.h"

namespace echoloop::sonar3d {

/// One field of a protobuf message; the member's type gives the wire type.
template <class M, class T>
struct Field {
    std::uint32_t number;
    T M::*member;
    std::string_view name, unit, help;
};
template <class M, class T>
Field(std::uint32_t, T M::*, std::string_view, std::string_view, std::string_view) -> Field<M, T>;

/// google.protobuf.Any inside the outermost message.
struct Any {
    std::string type_url;
    wire::Bytes value;
};
struct Envelope {
    Any msg;
};

template <class M>
struct Fields;

template <>
struct Fields<Timestamp> {
    static constexpr std::string_view name = "Timestamp", help = "google.protobuf.Timestamp, Unix time";
    static constexpr auto rows = std::tuple(Field{1, &Timestamp::seconds, "seconds", "s", "since 1970, UTC"},
                                            Field{2, &Timestamp::nanos, "nanos", "ns", "behind the second"});
};

template <>
struct Fields<Header> {
    static constexpr std::string_view name = "Header", help = "the same in all messages of one shot";
    static constexpr auto rows =
        std::tuple(Field{1, &Header::timestamp, "timestamp", "", "of the shot"},
                   Field{2, &Header::sequence_id, "sequence_id", "", "counts shots, wraps to 0"});
};

template <>
struct Fields<RangeImage> {
    using M = RangeImage;
    static constexpr std::string_view name = "RangeImage",
                                      help = "distance to the strongest reflection in each direction";
    static constexpr auto rows = std::tuple(
        Field{1, &M::header, "header", "", "of the shot"},
        Field{2, &M::speed_of_sound, "speed_of_sound", "m/s", "that distances are computed with"},
        Field{3, &M::range, "range", "m", "the largest that is set"},
        Field{4, &M::frequency, "frequency", "", "documented in Hz; a real sonar sends 5"},
        Field{5, &M::width, "width", "", "pixels of a row"}, Field{6, &M::height, "height", "", "rows"},
        Field{7, &M::fov_horizontal, "fov_horizontal", "deg", "between the outer pixels of a row"},
        Field{8, &M::fov_vertical, "fov_vertical", "deg", "between the first and the last row"},
        Field{9, &M::image_pixel_scale, "image_pixel_scale", "m", "of one count"},
        Field{10, &M::image_pixel_data, "image_pixel_data", "", "16 bit each, row by row; 0: no return"});
};

template <>
struct Fields<BitmapImage> {
    using M = BitmapImage;
    static constexpr std::string_view name = "BitmapImageGreyscale8",
                                      help = "strength of the strongest reflection in each direction";
    static constexpr auto rows = std::tuple(
        Field{1, &M::header, "header", "", "of the shot"},
        Field{2, &M::speed_of_sound, "speed_of_sound", "m/s", "that distances are computed with"},
        Field{3, &M::range, "range", "m", "the largest that is set"},
        Field{4, &M::frequency, "frequency", "", "documented in Hz; a real sonar sends 5"},
        Field{5, &M::type, "type", "", "0 signal strength, 1 shaded"},
        Field{6, &M::width, "width", "", "pixels of a row"}, Field{7, &M::height, "height", "", "rows"},
        Field{8, &M::fov_horizontal, "fov_horizontal", "deg", "between the outer pixels of a row"},
        Field{9, &M::fov_vertical, "fov_vertical", "deg", "between the first and the last row"},
        Field{10, &M::image_pixel_data, "image_pixel_data", "",
              "100 log10(linear / 30), row by row; 0: no return"});
};

template <>
struct Fields<Any> {
    static constexpr std::string_view name = "Any", help = "google.protobuf.Any";
    static constexpr auto rows =
        std::tuple(Field{1, &Any::type_url, "type_url", "", "type.googleapis.com/PACKAGE.MESSAGE"},
                   Field{2, &Any::value, "value", "", "the message"});
};

template <>
struct Fields<Envelope> {
    static constexpr std::string_view name = "Packet", help = "the payload of a packet";
    static constexpr auto rows = std::tuple(Field{1, &Envelope::msg, "msg", "", "any message"});
};

}  // namespace echoloop::sonar3d
