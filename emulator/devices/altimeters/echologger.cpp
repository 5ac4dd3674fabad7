#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "emulator/devices/altimeters/altimeters.h"
#include "protocols/nmea/sentences.h"

namespace echoloop::altimeters {
namespace {

constexpr Time silence = std::chrono::milliseconds(100);
constexpr std::size_t longest_text = 64;
const nmea::Style style{"SD", 3};

}  // namespace

EchologgerEct::EchologgerEct(const Echologger& settings, Wiring wiring)
    : Altimeter(settings.sounding, std::move(wiring)), settings_(settings) {}

Actions EchologgerEct::received(const Received& data, Time now) {
    for (const std::uint8_t byte : data.bytes) {
        const char c = static_cast<char>(byte);
        const bool ends = c == '\r' || c == '\n';
        if ((ends || c == '#') && !text_.empty()) obey(std::exchange(text_, {}), now);
        if (c == '#' || (!ends && !text_.empty() && text_.size() < longest_text))
            text_ += c;
        else if (!ends)
            ++counters_.skipped_bytes;
    }
    other_wake_ = text_.empty() ? Time::max() : now + silence;
    return take_actions();
}

Actions EchologgerEct::woken(Time now) {
    if (now >= other_wake_) {
        other_wake_ = Time::max();
        obey(std::exchange(text_, {}), now);
    }
    return Altimeter::woken(now);
}

void EchologgerEct::obey(const std::string& text, Time now) {
    const std::size_t space = std::min(text.find(' '), text.size());
    const std::string name = text.substr(0, space), value = text.substr(std::min(space + 1, text.size()));
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool numbered = error == std::errc() && end == value.data() + value.size() && std::isfinite(number);
    bool taken = true;
    if (name == "#") {
        running_ = false;
        stop();
    } else if (name == "#go") {
        running_ = true;
        run_freely(now);
    } else {
        taken = numbered && set(name, number);
        if (taken) change(settings_.sounding);
        if (taken && running_) run_freely(now);
    }
    ++(taken ? counters_.messages : counters_.rejected);
}

bool EchologgerEct::set(const std::string& name, double value) {
    const auto within = [&](double low, double high) { return value >= low && value <= high; };
    const bool is_flag = value == 0 || value == 1;
    if (name == "#range" && within(1000, 100000)) return settings_.sounding.range = value / 1000, true;
    if (name == "#interval" && within(0.1, 3600)) return settings_.sounding.rate = 1 / value, true;
    if (name == "#output" && (value == 1 || value == 3)) return settings_.nmea = value == 3, true;
    if (name == "#deadzone" && within(0, 10000)) return settings_.dead_zone = value / 1000, true;
    if (name == "#offset" && within(-10000, 10000)) return settings_.offset = value / 1000, true;
    if (name == "#nmeadpt" && is_flag) return tells_dpt_ = value == 1, true;
    if (name == "#nmeamtw" && is_flag) return tells_mtw_ = value == 1, true;
    return false;
}

std::vector<std::string> EchologgerEct::lines(std::optional<double> metres, Time now) {
    if (metres && *metres <= settings_.dead_zone) metres.reset();
    const double told = metres ? std::max(0.0, *metres + settings_.offset) : 0;
    if (!settings_.nmea)
        return {altimeter::write_line({.format = altimeter::Format::metres, .metres = told})};
    std::vector<std::string> all{nmea::depth_below("DBT", told, style)};
    if (tells_dpt_) all.push_back(nmea::dpt(told, 0, settings_.sounding.range, style));
    if (tells_mtw_)
        all.push_back(nmea::mtw(
            settings_.sounding.sensors.read("water", settings_.temperature, stray::water_temperature, now),
            style));
    return all;
}

}  // namespace echoloop::altimeters
