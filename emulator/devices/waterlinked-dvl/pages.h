// The pages of a DVL's HTTP interface. Pure functions; know no connection.
#pragma once

#include "emulator/devices/waterlinked-dvl/commands.h"
#include "protocols/http/request.h"

namespace echoloop::waterlinked_dvl {

/// An output as /api/v1/outputs/ lists it.
struct OutputRow {
    std::string id;      ///< "tcp_water_linked"
    int port = 0;        ///< 0: none
    std::string format;  ///< "json_v3.3"
    std::size_t clients = 0;
};

/// A whole response.
Bytes page(const http::Request& request, const State& state, const std::vector<OutputRow>& outputs,
           const Settings& settings, double temperature);

}  // namespace echoloop::waterlinked_dvl
