#include "emulator/capture/watches.h"

#include <algorithm>

namespace echoloop {

Wanted Watches::wants_ping(std::string_view device, const Shot& shot) {
    Wanted most = Wanted::nothing;
    std::vector<bool> by;
    for (Watch* watch : all_) {
        const Wanted wanted = watch->wants_ping(device, shot);
        most = std::max(most, wanted);
        by.push_back(wanted != Wanted::nothing);
    }
    if (most == Wanted::nothing) return most;
    const std::scoped_lock lock(mutex_);
    wanted_[std::string(device)][shot.ping] = std::move(by);
    return most;
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
