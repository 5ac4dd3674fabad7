// The user block that a head reports in mtBBUserData, and bytes that a user gives as hex. Reads no file but
// one that an option names.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocols/seanet/messages.h"

namespace echoloop::tritech {

/// The block of a DST or another head. `content`: hex from byte 13 on. `older`: the form of 175 bytes.
/// std::invalid_argument if the content does not fit.
seanet::BBUserData make_user_block(bool dst, bool half_duplex, bool older, const std::string& content);

/// Copies `bytes` to the front of `content`; std::invalid_argument naming `option` if they are too many.
void put_front(std::span<std::uint8_t> content, const std::vector<std::uint8_t>& bytes,
               const std::string& option);

}  // namespace echoloop::tritech
