// How long a device takes from echogram to bytes, by model. Renders nothing and opens no socket: the echogram
// is made up of noise with a bottom in it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "emulator/contract/model.h"

namespace echoloop::bench {

/// One kind of ping of one model, and what a host says so that it comes.
struct WireCase {
    struct Word {
        std::size_t port;
        Bytes bytes;
    };
    std::string name, model;
    Options options;          ///< other than their defaults
    std::vector<Word> words;  ///< after the device has started
};

struct WireFigures {
    std::string name;
    std::size_t beams = 0, bins = 0;        ///< of the echogram
    std::size_t messages = 0, bytes = 0;    ///< of one ping
    double median = 0, least = 0, p99 = 0;  ///< ms of processor time of one ping
};

std::vector<WireCase> wire_cases();
/// Of so many pings, after a few that only fill caches. Throws std::runtime_error for a device that does not
/// ping.
WireFigures measure_wire(const WireCase& the_case, std::size_t pings);

}  // namespace echoloop::bench
