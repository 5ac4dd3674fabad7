// What a driver that the scenario itself brings says to a device, and when: for runs without anybody outside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/contract/device.h"

namespace echoloop {

/// Something that is said once, or again and again.
struct DriverLine {
    Time at{};                ///< of the run
    Time every{};             ///< between one time and the next; 0: it is said once
    std::uint64_t times = 0;  ///< 0: until the run ends
    std::size_t port = 0;     ///< of Device::ports()
    /// One for each time, one after the other; behind the last the second comes again, or the only one.
    std::vector<Bytes> messages;

    /// What is said for the `n`th time, from 0.
    const Bytes& message(std::uint64_t n) const {
        const std::uint64_t all = messages.size();
        if (n < all) return messages[n];
        return all == 1 ? messages[0] : messages[1 + (n - 1) % (all - 1)];
    }
};

}  // namespace echoloop
