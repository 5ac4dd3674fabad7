// How long what a device says takes on its serial line, where that is as fast as a driver sets it (automatic
// baud). Knows no time of day.
#pragma once

#include <optional>
#include <vector>

#include "emulator/contract/device.h"
#include "emulator/contract/endpoint.h"
#include "emulator/contract/settings_list.h"

namespace echoloop {

struct SerialRate {
    double bits_per_second = 0;  ///< of the slowest line; 0: none is known
    bool automatic = true;
    std::optional<std::size_t> port;  ///< the one that is so slow; nothing: all are

    /// What a driver has set on the pty of `line`.
    void follow(std::size_t line, double rate) {
        if (!automatic) return;
        bits_per_second = rate;
        port = line;
    }

    Time time(const std::vector<Send>& sent) const {
        constexpr double bits_per_byte = 10;  // 8N1
        if (bits_per_second <= 0) return {};
        std::size_t bytes = 0;
        for (const Send& send : sent)
            if (!port || send.port == *port) bytes += send.bytes.size();
        return from_seconds(bits_per_byte * static_cast<double>(bytes) / bits_per_second);
    }
};

/// Lists the options `baud`, which is the rate of ptys and TCP in bit/s, and `automatic_baud`.
inline void describe(double& baud, SerialRate& line, OptionList& options) {
    const std::string_view source = "Ping specification notes";
    options.number(baud, "baud", "bit/s", 0, 4e6, "line rate of pty and TCP endpoints; 0: not paced", source);
    options.flag(line.automatic, "automatic_baud",
                 "a pty runs at the rate that its driver sets, whatever baud says; false: another rate than "
                 "baud gives garbage",
                 source);
}

}  // namespace echoloop
