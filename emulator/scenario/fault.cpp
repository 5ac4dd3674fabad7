#include "emulator/scenario/fault.h"

namespace echoloop {
namespace {

Time later(Time from, Time by) { return by > Time::max() - from ? Time::max() : from + by; }

}  // namespace

std::string_view name_of(Towards direction) {
    switch (direction) {
        case Towards::to_driver:
            return "to_driver";
        case Towards::from_driver:
            return "from_driver";
        case Towards::both:
            break;
    }
    return "both";
}

std::optional<Time> Fault::on_until(Time now) const {
    if (now < from) return {};
    const Time begun = every > Time{} ? now - (now - from) % every : from;
    const Time end = later(begun, length);
    return now < end ? std::optional(end) : std::nullopt;
}

std::optional<Time> Fault::next_change(Time now) const {
    if (now < from) return from;
    if (every <= Time{}) {
        const Time end = later(from, length);
        return now < end && end != Time::max() ? std::optional(end) : std::nullopt;
    }
    const Time begun = now - (now - from) % every;
    const Time end = later(begun, length);
    return now < end && length < every ? end : later(begun, every);
}

}  // namespace echoloop
