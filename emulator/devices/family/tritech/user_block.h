// The user block that a head reports in mtBBUserData, and bytes that a user gives as hex. Reads no file but
// one that an option names.
#pragma once

#include <span>

#include "emulator/contract/model.h"
#include "protocols/seanet/messages.h"

namespace echoloop::tritech {

/// The block of a DST or another head, as the options want it. std::invalid_argument if they do not fit.
seanet::BBUserData read_user_block(const Options& options, bool dst);

/// Copies `bytes` to the front of `content`; std::invalid_argument naming `option` if they are too many.
void put_front(std::span<std::uint8_t> content, const std::vector<std::uint8_t>& bytes,
               const std::string& option);

}  // namespace echoloop::tritech
