// What the messages of all Cerulean sonars have in common, as plain structs. No wire code: layouts.h says how
// they stand on the line. Acknowledgements, requests and versions are those of protocols/ping.
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/cerulean/ids.h"
#include "protocols/ping/common_messages.h"

namespace echoloop::cerulean {

/// Bytes 4 to 7 of a frame.
struct Header {
    Id id{};
    std::uint8_t source = 0;       ///< 0 for hosts
    std::uint8_t destination = 0;  ///< 0

    friend bool operator==(const Header&, const Header&) = default;
};
/// Text in JSON, e.g. the first message of a .svlog file.
struct JsonWrapper {
    std::vector<std::uint8_t> text;  ///< UTF-8

    friend bool operator==(const JsonWrapper&, const JsonWrapper&) = default;
};
/// For distances and pulse times; the id of older definitions and of the S500.
struct SetSpeedOfSound {
    std::uint32_t speed_of_sound = 0;  ///< mm/s

    friend bool operator==(const SetSpeedOfSound&, const SetSpeedOfSound&) = default;
};
/// The same under the id of the newest definitions.
struct GeneralSpeedOfSound {
    std::uint32_t speed_of_sound = 0;  ///< mm/s

    friend bool operator==(const GeneralSpeedOfSound&, const GeneralSpeedOfSound&) = default;
};

}  // namespace echoloop::cerulean
