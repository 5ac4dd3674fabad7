// Threads on which devices make bytes of large echograms, so that the wires of others do not wait.
#pragma once

#include <memory>

#include "emulator/asio.h"

namespace echoloop {

/// How much a run asks of the machine to be on time: what anybody may ask, or what needs rights.
enum class Punctuality { ordinary, real_time };

/// Two of them. Throws StartError with the remedy if real time is asked for and not permitted.
std::shared_ptr<asio::thread_pool> make_listeners(Punctuality punctuality);

}  // namespace echoloop
