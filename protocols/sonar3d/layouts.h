// The fields of the Sonar 3D-15's protobuf messages: number, member, name, unit and meaning. Tables only.
#pragma once

#include "protocols/sonar3d/messages.h"
#include "protocols/wire/protobuf.h"

namespace echoloop::sonar3d {

/// google.protobuf.Any inside the outermost message.
struct Any {
    std::string type_url;
    wire::Bytes value;
};
struct Envelope {
    Any msg;
};

using wire::Tag;
using wire::protobuf::Field;
using wire::protobuf::make_message;

constexpr auto protobuf_layout(Tag<Timestamp>) {
    return make_message("Timestamp", "google.protobuf.Timestamp, Unix time",
                        Field{1, &Timestamp::seconds, "seconds", "s", "since 1970, UTC"},
                        Field{2, &Timestamp::nanos, "nanos", "ns", "behind the second"});
}

constexpr auto protobuf_layout(Tag<Header>) {
    return make_message("Header", "the same in all messages of one shot",
                        Field{1, &Header::timestamp, "timestamp", "", "of the shot"},
                        Field{2, &Header::sequence_id, "sequence_id", "", "counts shots, wraps to 0"});
}

constexpr auto protobuf_layout(Tag<RangeImage>) {
    using M = RangeImage;
    return make_message(
        "RangeImage", "distance to the strongest reflection in each direction",

        Field{1, &M::header, "header", "", "of the shot"},
        Field{2, &M::speed_of_sound, "speed_of_sound", "m/s", "that distances are computed with"},
        Field{3, &M::range, "range", "m", "the largest that is set"},
        Field{4, &M::frequency, "frequency", "", "documented in Hz; a real sonar sends 5"},
        Field{5, &M::width, "width", "", "pixels of a row"}, Field{6, &M::height, "height", "", "rows"},
        Field{7, &M::fov_horizontal, "fov_horizontal", "deg", "between the outer pixels of a row"},
        Field{8, &M::fov_vertical, "fov_vertical", "deg", "between the first and the last row"},
        Field{9, &M::image_pixel_scale, "image_pixel_scale", "m", "of one count"},
        Field{10, &M::image_pixel_data, "image_pixel_data", "", "16 bit each, row by row; 0: no return"});
}

constexpr auto protobuf_layout(Tag<BitmapImage>) {
    using M = BitmapImage;
    return make_message(
        "BitmapImageGreyscale8", "strength of the strongest reflection in each direction",

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
}

constexpr auto protobuf_layout(Tag<Any>) {
    return make_message("Any", "google.protobuf.Any",
                        Field{1, &Any::type_url, "type_url", "", "type.googleapis.com/PACKAGE.MESSAGE"},
                        Field{2, &Any::value, "value", "", "the message"});
}

constexpr auto protobuf_layout(Tag<Envelope>) {
    return make_message("Packet", "the payload of a packet",
                        Field{1, &Envelope::msg, "msg", "", "any message"});
}

}  // namespace echoloop::sonar3d
