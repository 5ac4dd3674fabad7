#include "emulator/capture/watches.h"

#include <algorithm>

namespace echoloop {

bool Watches::wants_ping(std::string_view device, const Shot& shot) {
    std::vector<bool> by;
    for (Watch* watch : all_) by.push_back(watch->wants_ping(device, shot));
    if (std::ranges::find(by, true) == by.end()) return false;
    const std::scoped_lock lock(mutex_);
    wanted_[std::string(device)][shot.ping] = std::move(by);
    return true;
}

void Watches::ping(const SeenPing& ping) {
    std::vector<bool> by;
    {
        const std::scoped_lock lock(mutex_);
        const auto device = wanted_.find(ping.device);
        if (device == wanted_.end()) return;
        const auto found = device->second.find(ping.echogram.shot.ping);
        if (found == device->second.end()) return;
        by = std::move(found->second);
        // Pings come in their order: those before it were lost with the device's power.
        device->second.erase(device->second.begin(), std::next(found));
    }
    for (std::size_t i = 0; i < all_.size(); ++i)
        if (by[i]) all_[i]->ping(ping);
}

void Watches::bytes(const SeenBytes& bytes) {
    for (Watch* watch : all_) watch->bytes(bytes);
}

void Watches::fault(const SeenFault& fault) {
    for (Watch* watch : all_) watch->fault(fault);
}

}  // namespace echoloop
