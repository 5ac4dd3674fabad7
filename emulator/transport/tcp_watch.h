// Notices that the host at the other end of a TCP connection is gone: one that lost its power or its cable
// says no goodbye.
#pragma once

#include <memory>

#include "emulator/clock/asio.h"

namespace echoloop {

/// Closes `socket` some ten seconds after its host has stopped to answer, while it is idle as well; never for
/// a driver that merely does not read.
void watch_far_end(const std::shared_ptr<asio::ip::tcp::socket>& socket);

}  // namespace echoloop
