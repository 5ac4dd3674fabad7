// Where a device that speaks first sends its words: to the other ends of lines, or as datagrams to hosts.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "emulator/contract/device.h"
#include "emulator/contract/endpoint.h"

namespace echoloop::talker {

struct Wiring {
    Port port;
    Address host;  ///< of datagrams
};

/// One to `most` endpoints of any kind but udp-listen, since nobody would speak first. Up to eight programs
/// may connect to one that listens, if `most` is more than one. std::invalid_argument that names `model`
/// otherwise.
std::vector<Wiring> read_wiring(const std::vector<Endpoint>& endpoints, const std::string& model,
                                std::size_t most = 1);

}  // namespace echoloop::talker
