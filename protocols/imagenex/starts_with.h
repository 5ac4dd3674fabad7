// Messages of Imagenex begin with letters that tell them apart.
#pragma once

#include <algorithm>
#include <string_view>

#include "protocols/wire/bytes.h"

namespace echoloop::imagenex {

inline bool starts_with(wire::ByteView bytes, std::string_view text) {
    return bytes.size() >= text.size() && std::equal(text.begin(), text.end(), bytes.begin());
}

}  // namespace echoloop::imagenex
