// Conversions between device addresses and asio endpoints, and the error of a bind that failed. Opens
// nothing.
#pragma once

#include <string>

#include "emulator/clock/asio.h"
#include "emulator/contract/device.h"
#include "emulator/contract/error.h"

namespace echoloop {

template <class Endpoint>
Endpoint to_endpoint(Address address) {
    return {asio::ip::address_v4(address.ip), address.port};
}

template <class Endpoint>
Address to_address(const Endpoint& endpoint) {
    return {endpoint.address().is_v4() ? endpoint.address().to_v4().to_uint() : 0, endpoint.port()};
}

inline std::string to_text(Address address) {
    return asio::ip::address_v4(address.ip).to_string() + ":" + std::to_string(address.port);
}

/// StartError for a local address that cannot be had.
inline StartError bind_error(const std::string& what, const error_code& ec) {
    if (ec == asio::error::address_in_use)
        return {Exit::unavailable, what +
                                       ": already in use by another program (`ss -lunpt` shows which); "
                                       "end it or name another port in the endpoint"};
    if (ec == asio::error::access_denied)
        return {Exit::no_permission, what + ": not permitted; choose a port above 1023"};
    return {Exit::unavailable, what + ": " + ec.message() + "; the address must belong to this machine"};
}

}  // namespace echoloop
