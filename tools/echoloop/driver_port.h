// Where a driver finds a sonar's line: the address in words, and the serial port that it opens. Opens
// nothing.
#pragma once

#include <string>

#include "emulator/contract/endpoint.h"
#include "emulator/scenario/scenario.h"

namespace echoloop::cli {

/// "127.0.0.1:9090"; port 0: "127.0.0.1, the port is chosen at the start".
std::string address_text(const std::string& host, int port);

/// bit/s of a device's serial line; what it is not paced by may as well be the usual rate.
int chosen_rate(const ScenarioDevice& device);

/// "/tmp/echoloop/micron, 115200 bit/s 8N1", "TCP, connect to 127.0.0.1:9090". `rate`: bit/s where the
/// endpoint names none.
std::string stream_address(const Endpoint& endpoint, int rate);

/// The serial port that a driver opens, and a command that makes it if the emulator does not.
struct SerialPort {
    std::string path;
    std::string preparation;
    int rate = 0;  ///< bit/s
};

/// Of a driver that opens serial ports only.
SerialPort port_for_driver(const ScenarioDevice& device, const Endpoint& end);

}  // namespace echoloop::cli
