// The messages that a Water Linked Sonar 3D-15 sends as protobuf, as plain structs. Data only.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "protocols/wire/bytes.h"

namespace echoloop::sonar3d {

/// google.protobuf.Timestamp: Unix time.
struct Timestamp {
    std::int64_t seconds = 0;
    std::int32_t nanos = 0;
    friend bool operator==(const Timestamp&, const Timestamp&) = default;
};

/// The same in all messages of one shot.
struct Header {
    Timestamp timestamp;
    std::uint32_t sequence_id = 0;  ///< counts shots, wraps to 0
    friend bool operator==(const Header&, const Header&) = default;
};

/// Distance to the strongest reflection in each direction.
struct RangeImage {
    Header header;
    float speed_of_sound = 0;  ///< m/s
    float range = 0;           ///< m, the largest that is set
    std::uint32_t frequency = 0;
    std::uint32_t width = 0, height = 0;
    float fov_horizontal = 0, fov_vertical = 0;   ///< deg, between the centres of the outer pixels
    float image_pixel_scale = 0;                  ///< m per count
    std::vector<std::uint32_t> image_pixel_data;  ///< rows of `width`, 16 bit each; 0: no return
    friend bool operator==(const RangeImage&, const RangeImage&) = default;
};

/// BitmapImageGreyscale8: strength of those reflections.
struct BitmapImage {
    Header header;
    float speed_of_sound = 0;  ///< m/s
    float range = 0;           ///< m
    std::uint32_t frequency = 0;
    std::uint32_t type = 0;  ///< 0 signal strength, 1 shaded
    std::uint32_t width = 0, height = 0;
    float fov_horizontal = 0, fov_vertical = 0;  ///< deg
    wire::Bytes image_pixel_data;                ///< 100 log10(linear / 30); 0: no return
    friend bool operator==(const BitmapImage&, const BitmapImage&) = default;
};

/// Of a type that is not known here: readers skip it.
struct OtherMessage {
    wire::Bytes value;
    friend bool operator==(const OtherMessage&, const OtherMessage&) = default;
};

using Message = std::variant<RangeImage, BitmapImage, OtherMessage>;

enum class Version { rip1, rip2 };  ///< rip2 is compressed

struct Packet {
    Version version = Version::rip2;
    std::string type_url;  ///< "type.googleapis.com/PACKAGE.MESSAGE"; its last word tells the message
    Message message;
    friend bool operator==(const Packet&, const Packet&) = default;
};

}  // namespace echoloop::sonar3d
