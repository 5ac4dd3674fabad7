// The paths of the Sonar 3D-15's HTTP interface: what they read and set. Pure functions; knows no connection.
#pragma once

#include "emulator/devices/sonar-3d-15/settings.h"
#include "protocols/http/request.h"

namespace echoloop::sonar_3d_15 {

struct Answer {
    int status = 404;
    std::string body{};  ///< JSON; empty: none
    double after = 0;    ///< s, for which it keeps the host waiting
};

/// Changes `state` only if the answer is 204.
Answer answer(const http::Request& request, State& state, const Settings& settings);

}  // namespace echoloop::sonar_3d_15
