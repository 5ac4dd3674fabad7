// From a device's ports and endpoint URIs to open transports. Opens all or, by exception, none.
#pragma once

#include <memory>
#include <vector>

#include "emulator/clock.h"
#include "emulator/device.h"
#include "emulator/model.h"
#include "emulator/transport/transport.h"

namespace echoloop {

/// A byte pipe to an endpoint of a scenario, not paced. Throws StartError.
std::unique_ptr<Transport> open_endpoint(asio::io_context& io, const std::string& uri);

/// One transport per port: a datagram port binds its own address, stream port i is endpoint i of the
/// configuration. Streams over anything but a real serial port are paced by the option "baud", where the
/// model has one. Throws StartError.
std::vector<std::unique_ptr<Transport>> make_transports(Clock& clock, const std::vector<Port>& ports,
                                                        const DeviceConfig& config);

}  // namespace echoloop
