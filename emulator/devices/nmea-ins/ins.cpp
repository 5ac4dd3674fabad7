#include "emulator/devices/nmea-ins/ins.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocols/motion/reading.h"
#include "protocols/nmea/navigation.h"

namespace echoloop::nmea_ins {
namespace {

constexpr Time longest_pause = std::chrono::seconds(1);  // what is older is not said any more

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// deg; TSS1 has it against the horizon, not about the pitched axis.
double roll_to_horizon(const survey::Reading& r) {
    return rad_to_deg(std::asin(std::sin(deg_to_rad(r.roll)) * std::cos(deg_to_rad(r.pitch))));
}

}  // namespace

NavigationUnit::NavigationUnit(const Settings& settings, std::vector<talker::Wiring> wiring)
    : settings_(settings),
      wiring_(std::move(wiring)),
      unit_(settings.sensors, {settings.latitude, settings.longitude, settings.height}, settings.strays,
            survey::MotionUnit::Mount::vehicle),
      before_(from_seconds(settings.unix_start - std::floor(settings.unix_start))) {}

std::vector<Port> NavigationUnit::ports() const {
    std::vector<Port> all;
    for (const talker::Wiring& one : wiring_) all.push_back(one.port);
    return all;
}

Time NavigationUnit::moment(std::size_t word) const {
    if (settings_.rates[word] == 0) return Time::max();
    return from_seconds(static_cast<double>(next_[word]) / settings_.rates[word]) - before_;
}

Time NavigationUnit::next_wake() const {
    Time next = Time::max();
    for (std::size_t word = 0; word < words.size(); ++word) next = std::min(next, moment(word));
    return next == Time::max() ? next : next + from_seconds(settings_.latency);
}

Actions NavigationUnit::started(Time now) {
    for (std::size_t word = 0; word < words.size(); ++word)
        while (moment(word) < now) ++next_[word];
    Actions actions;
    actions.wake = next_wake();
    return actions;
}

Actions NavigationUnit::received(const Received& data, Time) {
    counters_.skipped_bytes += data.bytes.size();
    return {};
}

Actions NavigationUnit::woken(Time now) {
    const Time end = now - from_seconds(settings_.latency);
    Actions actions;
    due_.clear();
    for (std::size_t word = 0; word < words.size(); ++word)
        while (moment(word) < end - longest_pause) ++next_[word];
    while (true) {
        Time first = Time::max();
        for (std::size_t word = 0; word < words.size(); ++word) first = std::min(first, moment(word));
        if (first > end) break;
        due_.emplace_back();
        for (std::size_t word = 0; word < words.size(); ++word) {
            due_.back()[word] = moment(word) == first;
            if (due_.back()[word]) ++next_[word];
        }
        actions.locate.push_back(first);
    }
    actions.wake = next_wake();
    return actions;
}

Actions NavigationUnit::located(std::span<const Located> places, Time) {
    Actions actions;
    for (std::size_t i = 0; i < std::min(places.size(), due_.size()); ++i) {
        const double seconds = to_seconds(places[i].time - last_.time);
        const Vec3 gained = places[i].motion.velocity - last_.motion.velocity;
        const double share = seconds > 0 ? 1 / seconds : 0;
        last_ = places[i];
        const survey::Reading reading = unit_.read(places[i]);
        const Time at = places[i].time + from_seconds(settings_.latency);
        for (std::size_t word = 0; word < words.size(); ++word) {
            if (!due_[i][word]) continue;
            const Bytes bytes = said(static_cast<Word>(word), reading, share * std::hypot(gained.x, gained.y),
                                     share * gained.z);
            for (std::size_t port = 0; port < wiring_.size(); ++port)
                if (std::ranges::count(settings_.ports[port], static_cast<Word>(word)) > 0)
                    actions.send.push_back({port, bytes, wiring_[port].host, at});
        }
    }
    return actions;
}

Bytes NavigationUnit::said(Word word, const survey::Reading& r, double horizontal, double vertical) const {
    const nmea::Moment time{settings_.unix_start + to_seconds(r.time) + settings_.time_error};
    const double heave = 0 - r.heave;
    switch (word) {
        case Word::gga:
            return bytes_of(
                nmea::gga({time, r.place.latitude, r.place.longitude, r.place.height}, settings_.talker));
        case Word::zda:
            return bytes_of(nmea::zda(time, settings_.talker));
        case Word::vtg:
            return bytes_of(nmea::vtg(r.course, r.speed, settings_.talker));
        case Word::hdt:
            return bytes_of(nmea::hdt(r.heading, settings_.talker));
        case Word::pashr: {
            const auto error = [](const Stray& stray) { return std::hypot(stray.drift, stray.noise); };
            return bytes_of(nmea::pashr({time, r.heading, r.roll, r.pitch, heave,
                                         error(settings_.strays.motion), error(settings_.strays.heading)}));
        }
        case Word::tss1:
            return motion::write({.format = motion::Format::tss1,
                                  .roll = roll_to_horizon(r),
                                  .pitch = r.pitch,
                                  .heave = heave,
                                  .horizontal = horizontal,
                                  .vertical = vertical});
        case Word::em3000:
            return motion::write({.format = motion::Format::em3000,
                                  .roll = r.roll,
                                  .pitch = r.pitch,
                                  .heave = heave,
                                  .heading = r.heading,
                                  .status = 0x90});
    }
    return {};
}

}  // namespace echoloop::nmea_ins
