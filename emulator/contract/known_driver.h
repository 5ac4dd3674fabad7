// What `echoloop endpoints` tells of a model: where it sends to, and which public drivers know it. Rows only.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace echoloop {

/// Where datagrams go that leave from no port of their own, or from one that no endpoint names.
struct Destination {
    std::string what;          ///< "images"
    std::size_t endpoint = 1;  ///< number of the endpoint that they go to; none are sent if there are fewer
    int offset = 0;            ///< added to that endpoint's port
    std::string words{};       ///< who hears the port called `what`, if the endpoints do not tell
};

/// A public driver, and what is written into its configuration or into a shell. In its lines stand for
///     {name}              the device's name in the scenario
///     {port} {rate}       the serial port that the driver opens, and its bit/s; {kbaud}: in kbit/s
///     {host} {number}     address and port of the device's first endpoint; {host 2} {number 2}: of its
///     second {images}            the port that a Destination of this name has {sitl}              the line
///     as ArduPilot's SITL calls it {serial}            the option of that name
/// A driver does not fit where a word stands for nothing: an endpoint that is not there, or that SITL cannot
/// reach.
struct KnownDriver {
    std::string format;  ///< "ros1", "ros2", "moos", "rock", "dune", "sitl", "python", "maker"
    std::string name;    ///< of the project
    std::vector<std::string> lines;
    std::string note{};
    std::string scheme{};  ///< of the first endpoint that the lines are for, e.g. "udp-listen"; "": any
};

/// `type`: ArduPilot's number of the kind of range finder.
inline KnownDriver range_finder_in_sitl(const std::string& type) {
    return {
        "sitl",
        "ArduPilot's range finder, in SITL",
        {"sim_vehicle.py -v ArduSub -A \"--serial5={sitl}\"", "param set SERIAL5_PROTOCOL 9",
         "param set SERIAL5_BAUD {kbaud}", "param set RNGFND1_TYPE " + type, "param set RNGFND1_ORIENT 25"},
        "type the lines with param into its console, then restart it; 25 looks down"};
}

}  // namespace echoloop
