// The messages of an ARIS as plain structs: its beacon, a controller's commands, and the parts of a frame.
// Data only; of a command the one part that its type names is there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocols/wire/bytes.h"

namespace echoloop::aris {

struct SoftwareVersion {
    std::uint32_t major = 0, minor = 0, build = 0;
    friend bool operator==(const SoftwareVersion&, const SoftwareVersion&) = default;
};

/// Capabilities or variants.
struct Names {
    std::vector<std::string> enabled;
    friend bool operator==(const Names&, const Names&) = default;
};

namespace system_type {
inline constexpr std::uint32_t aris1800 = 0, aris3000 = 1, aris1200 = 2;
}
namespace connection_state {
inline constexpr std::uint32_t available = 0, busy = 1;
}

/// The beacon.
struct Availability {
    std::uint32_t serial = 0;
    std::uint32_t system_type = 0;
    std::optional<SoftwareVersion> version;
    std::uint32_t state = 0;  ///< connection_state
    std::optional<Names> capabilities;
    std::uint32_t link = 0;           ///< 0 HomePlug, 1 Ethernet
    float cpu_temperature = 0;        ///< degC
    std::uint32_t power_down = 0;     ///< reason
    float temperature_limit = 0;      ///< degC
    std::uint32_t limit_seconds = 0;  ///< s
    bool diver_held = false;
    std::optional<Names> variants;
    friend bool operator==(const Availability&, const Availability&) = default;
};

enum class CommandType : std::uint32_t {
    set_date_time,
    set_receiver,
    set_stream,
    set_acoustics,
    set_salinity,
    set_telephoto,
    set_focus,
    force_focus,
    home_focus,
    set_mount,
    set_velocity,
    set_acceleration,
    set_position,
    stop_rotator,
    ping,
    set_syslog,
};

struct SetDateTime {
    std::string text;  ///< "2014-Jan-31 23:58:15"
    friend bool operator==(const SetDateTime&, const SetDateTime&) = default;
};
struct SetReceiver {
    std::uint32_t port = 0;
    std::string ip;  ///< empty: who is connected; 0.0.0.0: nobody
    friend bool operator==(const SetReceiver&, const SetReceiver&) = default;
};
struct PacketDelay {
    bool enable = false;
    std::uint32_t period = 0;  ///< us
    friend bool operator==(const PacketDelay&, const PacketDelay&) = default;
};
struct SetStream {
    std::optional<PacketDelay> delay;
    std::uint32_t loss_policy = 0;  ///< unused
    friend bool operator==(const SetStream&, const SetStream&) = default;
};
struct SetAcoustics {
    std::uint32_t cookie = 0;
    float frame_rate = 0;  ///< 1/s
    std::uint32_t samples = 0;
    std::uint32_t start_delay = 0;    ///< us
    std::uint32_t cycle_period = 0;   ///< us
    std::uint32_t sample_period = 0;  ///< us
    std::uint32_t pulse_width = 0;    ///< us
    std::uint32_t ping_mode = 0;
    bool transmit = false;
    std::uint32_t frequency = 0;  ///< 0 low, 1 high
    bool volts_150 = false;
    float gain = 0;  ///< dB
    friend bool operator==(const SetAcoustics&, const SetAcoustics&) = default;
};
struct SetSalinity {
    std::uint32_t salinity = 0;  ///< 0, 15 or 35
    friend bool operator==(const SetSalinity&, const SetSalinity&) = default;
};
struct SetTelephoto {
    bool telephoto = false;
    friend bool operator==(const SetTelephoto&, const SetTelephoto&) = default;
};
struct SetFocus {
    std::uint32_t position = 0;  ///< obsolete
    float range = 0;             ///< m
    friend bool operator==(const SetFocus&, const SetFocus&) = default;
};
struct ForceFocus {
    std::uint32_t direction = 0;  ///< 1 forward, 2 reverse
    friend bool operator==(const ForceFocus&, const ForceFocus&) = default;
};
struct Nothing {
    friend bool operator==(const Nothing&, const Nothing&) = default;
};
struct SetMount {
    std::uint32_t mount = 0;  ///< 0 pole, 1 tripod, 2 ROV
    friend bool operator==(const SetMount&, const SetMount&) = default;
};
struct AxisValue {
    std::uint32_t axis = 0;  ///< 0 pan, 1 roll, 2 tilt
    float value = 0;
    friend bool operator==(const AxisValue&, const AxisValue&) = default;
};
struct SetSyslog {
    std::string ip;
    friend bool operator==(const SetSyslog&, const SetSyslog&) = default;
};

struct Command {
    std::uint32_t type = 0;  ///< CommandType
    std::optional<SetDateTime> date_time;
    std::optional<SetReceiver> receiver;
    std::optional<SetStream> stream;
    std::optional<SetAcoustics> acoustics;
    std::optional<SetSalinity> salinity;
    std::optional<SetTelephoto> telephoto;
    std::optional<SetFocus> focus;
    std::optional<ForceFocus> focus_force;
    std::optional<Nothing> focus_home;
    std::optional<SetMount> mount;
    std::optional<AxisValue> velocity, acceleration, position, stop;
    std::optional<Nothing> ping;
    std::optional<SetSyslog> syslog;
    friend bool operator==(const Command&, const Command&) = default;
};

struct FramePart {
    std::uint32_t frame_index = 0;
    std::uint32_t total_data_size = 0;  ///< B
    wire::Bytes header;                 ///< of the first part: a FrameHeader
    wire::Bytes data;
    std::uint32_t data_offset = 0;
    std::uint32_t ack_port = 0;
    friend bool operator==(const FramePart&, const FramePart&) = default;
};

struct FramePartAck {
    std::uint32_t frame_index = 0;
    std::uint32_t data_offset = 0;  ///< expected next
    friend bool operator==(const FramePartAck&, const FramePartAck&) = default;
};

}  // namespace echoloop::aris
