// What hosts say to a DVL, as objects of JSON and as sentences of the serial line, and what it answers. Pure
// functions; know no connection.
#pragma once

#include <string>
#include <string_view>

#include "emulator/devices/waterlinked-dvl/settings.h"
#include "protocols/waterlinked/sentence.h"

namespace echoloop::waterlinked_dvl {

inline constexpr std::size_t most_triggers = 15;  ///< pings that wait

/// What commands read and change.
struct State {
    Configuration configuration;
    SerialOutput output = SerialOutput::v1_and_v2;
    std::size_t triggers = 0;  ///< pings that were asked for and have not begun
    std::string ntp_address = "auto";
    double clock_error = 0;                 ///< s, of its clock against the run's; set by hand
    double unix_now = 0;                    ///< s, of the run, when a command comes
    std::string address;                    ///< its own, "" without network
    bool reset = false, calibrate = false;  ///< was asked for
};

struct Answer {
    std::string text;   ///< with its line end
    bool good = false;  ///< it did what it was told
    double after = 0;   ///< s, for which the host waits
};

/// Of a JSON document, whole or not.
Answer answer(std::string_view document, State& state, const Settings& settings);
/// Of a line of the serial protocol, without its end.
Answer answer_sentence(std::string_view line, State& state, const Settings& settings);

/// The objects that get_config and get_version_info give, and the pages of HTTP.
std::string configuration_text(const Configuration& configuration);
std::string about_text(const Settings& settings);

/// Numbers that are out of bounds are refused.
bool is_speed_of_sound(double value);
bool is_rotation(double value);
/// "0x" and 14 digits.
std::string chip_text(const Settings& settings);

}  // namespace echoloop::waterlinked_dvl
