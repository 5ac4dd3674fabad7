// From a device's ports and endpoint URIs to open transports. Opens all or, by exception, none.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "emulator/clock/clock.h"
#include "emulator/contract/device.h"
#include "emulator/contract/driver_script.h"
#include "emulator/contract/model.h"
#include "emulator/transport/transport.h"

namespace echoloop {

/// Whether a place hangs up on a web browser, or may be a web interface itself, as recorded bytes may be.
enum class Browsers { turned_away, served };

/// A byte pipe to an endpoint of a scenario, not paced. Throws StartError.
/// `peers`: networks that may be sent to and may connect, where it is not on loopback; none: the interface's.
std::unique_ptr<Transport> open_endpoint(asio::io_context& io, const std::string& uri, Browsers browsers,
                                         std::span<const Network> peers = {});

/// Puts something around the wire of a port, or hands it back as it is; around each driver's where a port
/// has several.
using Around = std::function<std::unique_ptr<Transport>(std::unique_ptr<Transport>, const Port&)>;

/// One transport per port: a datagram port binds its own address, stream port i is endpoint i of the
/// configuration. A model with the option "baud" has a serial line: byte streams over anything but a real
/// port are as slow as that. A pty whose driver has set another rate carries garbage, unless the device's
/// "automatic_baud" follows it or the endpoint says not to check. `around` comes between the wire and what a
/// UART makes of it; nothing is put around anything before all ports are open. Throws StartError.
/// The endpoint of a stream port, for one port after the other: `next_stream` counts, from 0.
const Endpoint& endpoint_of(const Port& port, const std::vector<Endpoint>& endpoints,
                            std::size_t& next_stream);

std::vector<std::unique_ptr<Transport>> make_transports(Clock& clock, const std::vector<Port>& ports,
                                                        const DeviceConfig& config,
                                                        const Around& around = {});

/// The same for a run without anybody outside: at the other end of each port is a driver that says what
/// `script` has for it. Nothing is opened; the addresses are those that the configuration names, and of a
/// driver on loopback.
std::vector<std::unique_ptr<Transport>> make_scripted_transports(Clock& clock, const std::vector<Port>& ports,
                                                                 const DeviceConfig& config,
                                                                 std::span<const DriverLine> script,
                                                                 const Around& around = {});

}  // namespace echoloop
