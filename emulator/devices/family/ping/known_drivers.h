// The makers' Python package for devices of the Ping protocol, as `echoloop endpoints --format python` names
// it. Rows only.
#pragma once

#include <string>
#include <vector>

#include "emulator/contract/known_driver.h"

namespace echoloop::ping_device {

/// `type`: the package's class. `asks`: Python that uses `sonar`, an object of it that has answered. A class
/// without `connect_tcp` opens a serial port instead, which a line before the Python makes.
inline std::vector<KnownDriver> brping_drivers(const std::string& version, const std::string& type,
                                               const std::vector<std::string>& asks, bool tcp) {
    const auto lines = [&](const std::string& connect) {
        std::vector<std::string> all{"from brping import " + type, "sonar = " + type + "()",
                                     "sonar." + connect, "assert sonar.initialize()"};
        all.insert(all.end(), asks.begin(), asks.end());
        return all;
    };
    const std::string name = "bluerobotics-ping==" + version + " (PyPI)";
    std::vector<KnownDriver> rows{
        {"python", name, lines("connect_udp(\"{host}\", {number})"), "", "udp-listen"}};
    if (tcp) rows.push_back({"python", name, lines("connect_tcp(\"{host}\", {number})"), "", "tcp-listen"});
    rows.push_back({"python", name, lines("connect_serial(\"{port}\", {rate})")});
    return rows;
}

}  // namespace echoloop::ping_device
