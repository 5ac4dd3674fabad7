// The rows that the models of imaging heads share. Rows only.
#pragma once

#include <memory>
#include <stdexcept>

#include "emulator/devices/family/tritech/imaging.h"
#include "emulator/devices/family/tritech/imaging_drivers.h"

namespace echoloop::tritech {

/// Throws std::invalid_argument unless there is one endpoint.
inline void want_one_line(const DeviceConfig& config, const std::string& model) {
    if (config.endpoints.size() != 1)
        throw std::invalid_argument("a " + model + " has one serial line: give exactly one endpoint");
}

inline Model imaging_model(const std::string& name, const std::string& link, Family family) {
    Model m;
    m.name = name;
    m.protocol = "SeaNet, serial 115200 8N1";
    m.default_endpoints = {"pty:/tmp/echoloop/" + link};
    m.endpoint_schemes = {"pty", "serial", "tcp-listen", "tcp", "udp-listen", "udp"};
    m.turn_steps = turn_steps;
    list_settings<ImagingSettings>(m, family);
    m.profile = built_in_profile(m.name);
    m.family = "seanet";
    m.requests = imaging_requests;
    m.drivers = imaging_drivers(family);
    return m;
}

}  // namespace echoloop::tritech
