#include "emulator/devices/reson-7k/subscribers.h"

#include <algorithm>

namespace echoloop::reson7k_device {
namespace {

constexpr std::size_t most_peers = 24;  // 8 by TCP, and 16

}  // namespace

std::span<const std::uint32_t> ping_records() {
    static constexpr std::uint32_t types[] = {7000, 7503, 7004, 7027, 7011, 7018, 7042};
    return types;
}

bool Subscribers::add(const Peer& peer, const std::set<std::uint32_t>& types) {
    auto entry =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.peer == peer; });
    if (entry == entries_.end()) {
        if (entries_.size() == most_peers) return false;
        entry = entries_.insert(entries_.end(), Entry{peer, {}});
    }
    entry->types.insert(types.begin(), types.end());
    return true;
}

void Subscribers::remove(const Peer& peer, const std::set<std::uint32_t>& types) {
    for (Entry& entry : entries_)
        if (entry.peer == peer)
            for (const std::uint32_t type : types) entry.types.erase(type);
    std::erase_if(entries_, [](const Entry& e) { return e.types.empty(); });
}

bool Subscribers::end(const Peer& peer) {
    return std::erase_if(entries_, [&](const Entry& e) { return e.peer == peer; }) > 0;
}

bool Subscribers::wanted(std::uint32_t type) const {
    return std::any_of(entries_.begin(), entries_.end(),
                       [&](const Entry& e) { return e.types.contains(type); });
}

bool Subscribers::wanted(std::span<const std::uint32_t> types) const {
    return std::ranges::any_of(types, [this](std::uint32_t type) { return wanted(type); });
}

}  // namespace echoloop::reson7k_device
