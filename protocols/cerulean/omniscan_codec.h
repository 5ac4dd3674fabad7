// Messages of an Omniscan 450 to frames and back. Knows no state, time or device.
#pragma once

#include "protocols/cerulean/codec.h"
#include "protocols/cerulean/omniscan_messages.h"

namespace echoloop::cerulean::omniscan {

using Codec = cerulean::Codec<Message>;

/// Of its own messages, without those that all devices have.
std::vector<wire::Table> tables();

}  // namespace echoloop::cerulean::omniscan
