#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

#include "emulator/devices/altimeters/altimeters.h"
#include "protocols/nmea/sentences.h"

namespace echoloop::altimeters {
namespace {

constexpr std::size_t longest_command = 64;
constexpr double least_range = 0.1, most_range = 100;  // m

// Numbers of the commands; the even one of a pair sets in most, as its manual has them.
enum Number {
    set_unit = 21,
    get_unit,
    go = 28,
    version = 32,
    serial = 34,
    set_mode = 39,
    get_mode,
    set_format = 82,
    get_format = 89,
    set_error = 118,
    get_error,
    board = 136,
    calibration = 138,
    set_farthest = 823,
    get_farthest,
    set_sound = 830,
    get_sound,
    frequency = 839,
    set_nearest,
    get_nearest
};

/// Lower-case hex, as seven of seven examples of the manual have it.
std::string in_lower_case(std::string sentence) {
    const auto from = sentence.end() - static_cast<std::ptrdiff_t>(std::min<std::size_t>(sentence.size(), 4));
    std::transform(from, sentence.end(), from,
                   [](char c) { return c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c; });
    return sentence;
}

template <class... Values>
std::string printed(const char* format, Values... values) {
    char text[96];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

std::optional<double> number_in(const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> rate_of(const std::string& mode) {
    if (mode == "M1" || mode == "M2" || mode == "M4") return mode[1] - '0';
    return std::nullopt;
}

}  // namespace

ValeportVa500::ValeportVa500(const Valeport& settings, Wiring wiring)
    : Altimeter(settings.sounding, std::move(wiring), settings.running),
      settings_(settings),
      running_(settings.running) {}

Actions ValeportVa500::received(const Received& data, Time now) {
    for (const std::uint8_t byte : data.bytes) hear(static_cast<char>(byte), now);
    return take_actions();
}

void ValeportVa500::hear(char c, Time now) {
    if (c == '#') {
        line_ = "#";
        if (!running_) return;
        running_ = false;
        stop();
        say(">");
    } else if (running_) {
        ++counters_.skipped_bytes;
    } else if (c == '\r') {
        obey(std::exchange(line_, {}), now);
    } else if (c != '\n') {
        if (line_.size() < longest_command)
            line_ += c;
        else
            ++counters_.skipped_bytes;
    }
}

void ValeportVa500::obey(const std::string& line, Time now) {
    if (line.empty()) return;
    if (line == "#") return say(">");
    say(line + "\r\n");
    if (run(line, now)) {
        ++counters_.messages;
        return;
    }
    const std::size_t semicolon = std::min(line.find(';'), line.size());
    int number = 0;
    const char *from = line.data() + 1, *end = line.data() + semicolon;
    const bool numbered = line[0] == '#' && end > from && std::from_chars(from, end, number).ptr == end;
    const std::string value = line.substr(std::min(semicolon + 1, line.size()));
    const auto told = numbered ? answer(number, value) : std::nullopt;
    ++(told ? counters_.messages : counters_.rejected);
    if (told) say(*told + "\r\n");
    say(">");
}

/// Commands that let it ping.
bool ValeportVa500::run(const std::string& mode, Time now) {
    if (mode == "S" || (mode == "#028" && single_)) {
        ask(now);
        return true;
    }
    if (const auto rate = rate_of(mode)) {
        settings_.sounding.rate = *rate;
        change(settings_.sounding);
    } else if (mode != "#028") {
        return false;
    }
    running_ = true;
    run_freely(now);
    return true;
}

std::string ValeportVa500::told_mode() const {
    return single_ ? "S" : printed("M%.0f", settings_.sounding.rate);
}

std::optional<std::string> ValeportVa500::answer(int number, const std::string& value) {
    const auto set = [&](double& member, double low, double high) -> std::optional<std::string> {
        const auto asked = number_in(value);
        if (!asked || *asked < low || *asked > high) return std::nullopt;
        member = *asked;
        change(settings_.sounding);
        return value;
    };
    static const std::vector<std::string> formats{"NMEA", "SDDBT", "TRITEC", "BENTHOS"};
    switch (number) {
        case set_mode:
            if (const auto rate = rate_of(value)) {
                settings_.sounding.rate = *rate;
                change(settings_.sounding);
            } else if (value != "S") {
                return std::nullopt;
            }
            single_ = value == "S";
            return value;
        case get_mode:
            return told_mode();
        case set_format: {
            const auto found = std::ranges::find(formats, value);
            if (found == formats.end()) return std::nullopt;
            settings_.format = static_cast<Valeport::Format>(found - formats.begin());
            return value;
        }
        case get_format:
            return formats[static_cast<std::size_t>(settings_.format)];
        case set_unit:
            return range_unit_ = value;
        case get_unit:
            return range_unit_;
        case set_error:
            return settings_.error_text = value;
        case get_error:
            return settings_.error_text;
        case set_farthest:
            return set(settings_.sounding.range, least_range, most_range);
        case get_farthest:
            return printed("%.10g", settings_.sounding.range);
        case set_nearest:
            return set(shortest_, 0, most_range);
        case get_nearest:
            return printed("%.10g", shortest_);
        case set_sound:
            return set(settings_.sounding.sound_speed, 1300, 1700);
        case get_sound:
            return printed("%.10g", settings_.sounding.sound_speed);
        case version:
            return "0430701A4";
        case serial:
            return settings_.serial;
        case board:
            return "0430514";
        case calibration:
            return "14/03/2019";
        case frequency:
            return printed("%.0f", settings_.sounding.acoustics.frequency);
        default:
            return std::nullopt;
    }
}

std::string ValeportVa500::sentence(double metres, Time now) const {
    using Pressure = Valeport::Pressure;
    constexpr double feet = 0.3048, fathom = 6 * feet;  // m
    switch (settings_.format) {
        case Valeport::Format::sddbt:
            return nmea::sentence(
                printed("SDDBT,%.1f,f,%.1f,M,%.1f,F", metres / feet, metres, metres / fathom));
        case Valeport::Format::tritec:
            return altimeter::write_line({.metres = metres});
        case Valeport::Format::benthos:
            return altimeter::write_line({.format = altimeter::Format::benthos, .metres = metres});
        case Valeport::Format::nmea:
            break;
    }
    if (settings_.pressure == Pressure::none)
        return in_lower_case(nmea::sentence(printed("PRVAT,%06.3f,M", metres)));
    constexpr double dbar_per_metre = 1;
    const double pressure =
        settings_.pressure == Pressure::sensor
            ? std::max(0.0, settings_.sounding.sensors.read("pressure", dbar_per_metre * depth_,
                                                            dbar_per_metre * stray::depth, now))
            : 0;
    return in_lower_case(nmea::sentence(printed("PRVAT,%06.3f,M,%08.3f,dBar", metres, pressure)));
}

std::vector<std::string> ValeportVa500::lines(std::optional<double> metres, Time now) {
    using NoBottom = Valeport::NoBottom;
    if (metres && *metres < shortest_) metres.reset();
    if (metres) last_ = metres;
    std::vector<std::string> all;
    if (!metres && settings_.no_bottom == NoBottom::text)
        all.push_back(settings_.error_text + "\r\n");
    else if (metres || settings_.no_bottom != NoBottom::silent)
        all.push_back(
            sentence(metres.value_or(settings_.no_bottom == NoBottom::last ? last_.value_or(0) : 0), now));
    if (!running_) all.emplace_back(">");
    return all;
}

}  // namespace echoloop::altimeters
