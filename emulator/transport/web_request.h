// Whether whoever has connected is a web browser: any page that is open on the machine may let it send bytes
// of the page's choice to 127.0.0.1, after the first line of HTTP.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "emulator/contract/device.h"

namespace echoloop {

/// Looks at the first bytes of a connection, however they are cut.
class WebRequest {
  public:
    /// True once what has come so far begins with a method of HTTP and a space (RFC 9110, 9).
    bool is_begun_by(ByteView bytes) {
        const std::size_t taken = std::min(bytes.size(), begin_.size() - size_);
        std::copy_n(bytes.begin(), taken, begin_.begin() + static_cast<std::ptrdiff_t>(size_));
        size_ += taken;
        constexpr std::string_view methods[] = {"GET ",     "HEAD ",    "POST ",  "PUT ",  "DELETE ",
                                                "CONNECT ", "OPTIONS ", "TRACE ", "PATCH "};
        const std::string_view begin(begin_.data(), size_);
        return std::ranges::any_of(methods, [&](std::string_view m) { return begin.starts_with(m); });
    }

  private:
    std::array<char, 8> begin_{};
    std::size_t size_ = 0;
};

}  // namespace echoloop
