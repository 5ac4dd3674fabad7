#include "emulator/faults/faults.h"

#include <algorithm>

namespace echoloop {

void DeviceFaults::add(int id, Fault fault) {
    const auto kind = static_cast<std::size_t>(fault.kind);
    const Dice dice = Dice(random_key(seed_, name_)).of(kind + 1).of(so_far_[kind]++);
    asked_.push_back({id, std::move(fault), dice});
    tell_of_change();
}

bool DeviceFaults::clear(int id) {
    const auto found = std::ranges::find(asked_, id, &AskedFault::id);
    if (found == asked_.end()) return false;
    asked_.erase(found);
    tell_of_change();
    return true;
}

std::vector<std::string> DeviceFaults::on(Time now) const {
    std::vector<std::string> names;
    for (const AskedFault& asked : asked_)
        if (asked.fault.on_until(now))
            names.push_back(std::string(row_of(asked.fault.kind).name) + " " + std::to_string(asked.id));
    return names;
}

void DeviceFaults::record(Time now, const FaultPlace& place, const FaultEvent& event) {
    const auto found = std::ranges::find(asked_, event.id, &AskedFault::id);
    if (found != asked_.end()) ++found->made;
    labels_.add(now, place, event);
}

DeviceFaults& Faults::of(const std::string& device) {
    const auto found = std::ranges::find(devices_, device, &DeviceFaults::name);
    return found != devices_.end() ? *found : devices_.emplace_back(device, seed_, labels_);
}

int Faults::add(Fault fault) {
    const std::string device = fault.device;
    of(device).add(++last_id_, std::move(fault));
    return last_id_;
}

std::size_t Faults::count() const {
    std::size_t count = 0;
    for (const DeviceFaults& device : devices_) count += device.asked().size();
    return count;
}

bool Faults::clear(int id) {
    return std::ranges::any_of(devices_, [id](DeviceFaults& device) { return device.clear(id); });
}

std::size_t Faults::clear_all() {
    std::size_t count = 0;
    for (DeviceFaults& device : devices_)
        while (device.any() && device.clear(device.asked().front().id)) ++count;
    return count;
}

}  // namespace echoloop
