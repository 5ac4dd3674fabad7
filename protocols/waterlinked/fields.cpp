#include "protocols/waterlinked/fields.h"

#include <algorithm>
#include <array>

namespace echoloop::waterlinked {
/// In a namespace of its own, since the names are short.
namespace rows {

constexpr bool words = false;

constexpr std::array velocity{
    FieldRow{"time", "ms", "since the report before"},
    FieldRow{"vx", "m/s", "forward"},
    FieldRow{"vy", "m/s", "to starboard"},
    FieldRow{"vz", "m/s", "down"},
    FieldRow{"fom", "m/s", "figure of merit: root of the covariance's largest eigenvalue"},
    FieldRow{"covariance", "m^2/s^2", "3 rows of 3", words},
    FieldRow{"altitude", "m", "along z; -1 without a bottom"},
    FieldRow{"transducers", "", "of each: id, velocity, distance, rssi, nsd, beam_valid", words},
    FieldRow{"velocity_valid", "", "true or false", words},
    FieldRow{"status", "", "bit 0: hot, will stop soon"},
    FieldRow{"time_of_validity", "us", "Unix time of the reflection at the bottom"},
    FieldRow{"time_of_transmission", "us", "Unix time of this report"},
    FieldRow{"format", "", "json_v3.3 and so on", words},
    FieldRow{"type", "", "velocity, or velocity_water in water tracking", words},
};
constexpr std::array position{
    FieldRow{"ts", "s", "Unix time"},
    FieldRow{"x", "m", "forward at the reset"},
    FieldRow{"y", "m", "to starboard at the reset"},
    FieldRow{"z", "m", "down at the reset"},
    FieldRow{"std", "m", "standard deviation of the position"},
    FieldRow{"roll", "deg", ""},
    FieldRow{"pitch", "deg", ""},
    FieldRow{"yaw", "deg", ""},
    FieldRow{"type", "", "position_local", words},
    FieldRow{"status", "", "0 is good"},
    FieldRow{"format", "", "json_v3.3 and so on", words},
};
constexpr std::array response{
    FieldRow{"response_to", "", "the command", words},
    FieldRow{"success", "", "true or false", words},
    FieldRow{"error_message", "", "nothing on success", words},
    FieldRow{"result", "", "null, or what was asked for", words},
    FieldRow{"format", "", "json_v3.3 and so on", words},
    FieldRow{"type", "", "response", words},
};
constexpr std::array command{
    FieldRow{"command", "", "reset_dead_reckoning, set_config and so on", words},
    FieldRow{"parameters", "", "an object, where the command has some", words},
};
constexpr std::array json{
    MessageRow{"velocity", "JSON, a report of each ping", velocity},
    MessageRow{"velocity_water", "JSON, the same against a layer of water", velocity},
    MessageRow{"position_local", "JSON, dead reckoning", position},
    MessageRow{"response", "JSON, the answer to a command", response},
    MessageRow{"command", "JSON, from the host", command},
};

constexpr std::array wrz{
    FieldRow{"vx", "m/s", "forward"},
    FieldRow{"vy", "m/s", "to starboard"},
    FieldRow{"vz", "m/s", "down"},
    FieldRow{"valid", "", "y or n", words},
    FieldRow{"altitude", "m", "-1 without a bottom"},
    FieldRow{"fom", "m/s", "figure of merit"},
    FieldRow{"covariance", "m^2/s^2", "9 numbers with semicolons", words},
    FieldRow{"time_of_validity", "us", "of the reflection at the bottom"},
    FieldRow{"time_of_transmission", "us", "of this report"},
    FieldRow{"time", "ms", "since the report before"},
    FieldRow{"status", "", "bit 0: hot, will stop soon"},
};
constexpr std::array wru{
    FieldRow{"id", "", "of the transducer, 0 to 3"},
    FieldRow{"velocity", "m/s", "along the beam"},
    FieldRow{"distance", "m", "along the beam; -1 without an echo"},
    FieldRow{"rssi", "dBm", "strength of the echo"},
    FieldRow{"nsd", "dBm", "noise"},
};
constexpr std::array wrp{
    FieldRow{"ts", "s", "time"},
    FieldRow{"x", "m", "forward at the reset"},
    FieldRow{"y", "m", "to starboard at the reset"},
    FieldRow{"z", "m", "down at the reset"},
    FieldRow{"std", "m", "standard deviation of the position"},
    FieldRow{"roll", "deg", ""},
    FieldRow{"pitch", "deg", ""},
    FieldRow{"yaw", "deg", ""},
    FieldRow{"status", "", "0 is good"},
};
constexpr std::array wrx{
    FieldRow{"time", "ms", "since the report before"},
    FieldRow{"vx", "m/s", "forward"},
    FieldRow{"vy", "m/s", "to starboard"},
    FieldRow{"vz", "m/s", "down"},
    FieldRow{"fom", "m/s", "figure of merit"},
    FieldRow{"altitude", "m", "-1 without a bottom"},
    FieldRow{"valid", "", "y or n", words},
    FieldRow{"status", "", "bit 0: hot, will stop soon"},
};
constexpr std::array wrt{
    FieldRow{"distance_1", "m", "of transducer 0; -1 without an echo"},
    FieldRow{"distance_2", "m", ""},
    FieldRow{"distance_3", "m", ""},
    FieldRow{"distance_4", "m", ""},
};
constexpr std::array wrc{
    FieldRow{"speed_of_sound", "m/s", ""},
    FieldRow{"mounting_rotation_offset", "deg", ""},
    FieldRow{"acoustic_enabled", "", "y or n", words},
    FieldRow{"dark_mode_enabled", "", "y or n", words},
    FieldRow{"range_mode", "", "auto, =a, a<=b or wt", words},
    FieldRow{"periodic_cycling_enabled", "", "y or n", words},
};
constexpr std::array wrv{FieldRow{"version", "", "of the protocol", words}};
constexpr std::array wrw{
    FieldRow{"name", "", "of the product", words},
    FieldRow{"version", "", "of the software", words},
    FieldRow{"chip_id", "", "0x and hexadecimal digits", words},
    FieldRow{"address", "", "IPv4, where it has one", words},
};
constexpr std::array wcp{FieldRow{"output", "", "0 none, 1 V1 and V2, 2 PD6, 3 V2, 6 PD4"}};
constexpr std::span<const FieldRow> none{};
constexpr std::array serial{
    MessageRow{"wrz", "sentence, a report of each ping", wrz},
    MessageRow{"wru", "sentence, a transducer's part of it", wru},
    MessageRow{"wrp", "sentence, dead reckoning", wrp},
    MessageRow{"wrx", "sentence, a report of each ping in protocol V1", wrx},
    MessageRow{"wrt", "sentence, the distances of V1", wrt},
    MessageRow{"wrc", "sentence, the configuration", wrc},
    MessageRow{"wrv", "sentence, the version of the protocol", wrv},
    MessageRow{"wrw", "sentence, product and software", wrw},
    MessageRow{"wcs", "sentence from the host, sets the configuration; null fields keep what is", wrc},
    MessageRow{"wcp", "sentence from the host, chooses the output", wcp},
    MessageRow{"wcv", "sentence from the host, asks for the version", none},
    MessageRow{"wcw", "sentence from the host, asks for product and software", none},
    MessageRow{"wcc", "sentence from the host, asks for the configuration", none},
    MessageRow{"wcr", "sentence from the host, resets dead reckoning", none},
    MessageRow{"wcx", "sentence from the host, asks for a ping", none},
    MessageRow{"wcg", "sentence from the host, calibrates the gyroscope", none},
    MessageRow{"wra", "sentence, a command was obeyed", none},
    MessageRow{"wrn", "sentence, a command failed", none},
    MessageRow{"wr?", "sentence, a command was not understood", none},
    MessageRow{"wr!", "sentence, a command had a wrong checksum", none},
};

constexpr FieldRow pd6_valid{"valid", "", "A or V", words};
constexpr std::array sa{FieldRow{"pitch", "deg", ""}, FieldRow{"roll", "deg", ""},
                        FieldRow{"heading", "deg", ""}};
constexpr std::array ts{
    FieldRow{"time", "", "YYMMDDhhmmsshh", words},
    FieldRow{"salinity", "ppt", ""},
    FieldRow{"temperature", "degC", ""},
    FieldRow{"depth", "m", ""},
    FieldRow{"sound_speed", "m/s", ""},
    FieldRow{"built_in_test", "", ""},
};
constexpr std::array instrument{
    FieldRow{"x", "mm/s", ""},
    FieldRow{"y", "mm/s", ""},
    FieldRow{"z", "mm/s", ""},
    FieldRow{"error", "mm/s", ""},
    pd6_valid,
};
constexpr std::array ship{FieldRow{"starboard", "mm/s", ""}, FieldRow{"forward", "mm/s", ""},
                          FieldRow{"vertical", "mm/s", ""}, pd6_valid};
constexpr std::array earth{FieldRow{"east", "mm/s", ""}, FieldRow{"north", "mm/s", ""},
                           FieldRow{"up", "mm/s", ""}, pd6_valid};
constexpr std::array distances{
    FieldRow{"east", "m", ""},  FieldRow{"north", "m", ""},
    FieldRow{"up", "m", ""},    FieldRow{"range", "m", "to the bottom"},
    FieldRow{"since", "s", ""},
};
constexpr std::array ranges{
    FieldRow{"pressure", "kPa", ""}, FieldRow{"range_1", "dm", "to the bottom"},
    FieldRow{"range_2", "dm", ""},   FieldRow{"range_3", "dm", ""},
    FieldRow{"range_4", "dm", ""},
};
constexpr std::array health{
    FieldRow{"leak_a", "", "G good, L leak, D disconnected", words},
    FieldRow{"leak_b", "", "", words},
    FieldRow{"counts_a", "", "hexadecimal", words},
    FieldRow{"counts_b", "", "", words},
    FieldRow{"voltage", "V", "a star before what was measured anew", words},
    FieldRow{"current", "A", "", words},
    FieldRow{"impedance", "ohm", "", words},
};
constexpr std::array pd6{
    MessageRow{"SA", "PD6 line, attitude", sa},
    MessageRow{"TS", "PD6 line, time and water", ts},
    MessageRow{"RA", "PD13 line, pressure and ranges", ranges},
    MessageRow{"WI", "PD6 line, against the water, of the instrument", instrument},
    MessageRow{"WS", "PD6 line, against the water, of the ship", ship},
    MessageRow{"WE", "PD6 line, against the water, of the earth", earth},
    MessageRow{"WD", "PD6 line, way through the water", distances},
    MessageRow{"BI", "PD6 line, against the bottom, of the instrument", instrument},
    MessageRow{"BS", "PD6 line, against the bottom, of the ship", ship},
    MessageRow{"BE", "PD6 line, against the bottom, of the earth", earth},
    MessageRow{"BD", "PD6 line, way over the bottom", distances},
    MessageRow{"HM", "PD6 line, health", health},
};

}  // namespace rows

std::span<const MessageRow> json_messages() { return rows::json; }
std::span<const MessageRow> sentences() { return rows::serial; }
std::span<const MessageRow> pd6_lines() { return rows::pd6; }

const MessageRow* find_row(std::span<const MessageRow> among, std::string_view name) {
    const auto found = std::ranges::find(among, name, &MessageRow::name);
    return found == among.end() ? nullptr : &*found;
}

}  // namespace echoloop::waterlinked
