#include "emulator/devices/teledyne-dvl/console.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>

#include "emulator/devices/family/doppler/moment.h"

namespace echoloop::teledyne_dvl {
namespace {

constexpr std::string_view prompt = "\r\n>", refusal = " ERR: Bad command parameters!\r\n>";

Reply refused() { return {.text = std::string(refusal), .good = false}; }
Reply done() { return {.text = std::string(prompt)}; }
Reply told(const std::string& text) { return {.text = "\r\n" + text + std::string(prompt)}; }

std::optional<int> number_in(std::string_view text, int low, int high) {
    if (text.starts_with('+')) text.remove_prefix(1);
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size() && !text.empty();
    return whole && value >= low && value <= high ? std::optional(value) : std::nullopt;
}

bool are_digits(std::string_view text, std::size_t count) {
    return text.size() == count && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// A command that sets a whole number.
struct Whole {
    std::string_view name;
    int Setup::*member;
    int low, high;
    const char* form;
    std::string_view help;
};
constexpr std::array wholes{
    Whole{"BK", &Setup::water_mode, 0, 3, "%01d", "WMass Mode [0=off 1=WB 2=LostB 3=W]"},
    Whole{"BP", &Setup::bottom_pings, 0, 999, "%03d", "Bottom Track Pings per Ensemble"},
    Whole{"BX", &Setup::most_depth, 10, 65535, "%05d", "Maximum Tracking Depth (dm)"},
    Whole{"EA", &Setup::alignment, -17999, 18000, "%+06d", "Heading Alignment (1/100 deg)"},
    Whole{"EC", &Setup::sound_speed, 1400, 1600, "%04d", "Speed Of Sound (m/s)"},
    Whole{"ED", &Setup::depth, 0, 65535, "%05d", "Transducer Depth (dm)"},
    Whole{"ES", &Setup::salinity, 0, 50, "%02d", "Salinity (0-50)"},
    Whole{"WF", &Setup::blank, 0, 9999, "%04d", "Blank After Transmit (cm)"},
    Whole{"WN", &Setup::cells, 1, 255, "%03d", "Number of depth cells"},
    Whole{"WP", &Setup::profile_pings, 0, 16384, "%05d", "Pings per Ensemble"},
    Whole{"WS", &Setup::cell_size, 10, 800, "%04d", "Depth Cell Size (cm)"}};

/// They are taken with any number behind them, and change nothing here.
constexpr std::array<std::string_view, 23> idle{"BA", "BB", "BC", "BE", "BF", "BM", "BR", "BS",
                                                "CB", "CX", "CP", "CT", "EB", "EH", "EP", "ER",
                                                "ET", "EZ", "WA", "WB", "WD", "WM", "WV"};

Reply set_frame(std::string_view value, Setup& setup) {
    if (!are_digits(value, 5) || value.find_first_not_of("01") != std::string_view::npos) return refused();
    setup.frame = static_cast<Frame>(2 * (value[0] - '0') + (value[1] - '0'));
    setup.tilts = value[2] == '1';
    setup.three_beams = value[3] == '1';
    setup.bin_mapping = value[4] == '1';
    return done();
}

Reply set_flow(std::string_view value, Setup& setup) {
    if (!are_digits(value, 5)) return refused();
    setup.pings_by_itself = value[1] != '0';
    return done();
}

Reply set_format(std::string_view value, Setup& setup) {
    const auto number = number_in(value, 0, 99);
    for (const Format format : {Format::pd0, Format::pd4, Format::pd5, Format::pd6, Format::pd13})
        if (number == static_cast<int>(format)) {
            setup.format = format;
            return done();
        }
    return refused();
}

/// "080,0160,0240": how thick it is at least, where it begins and ends, dm.
Reply set_layer(std::string_view value, Setup& setup) {
    std::array<int, 3> parts{};
    constexpr std::array most{640, 9999, 9999};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::size_t comma = value.find(',');
        if ((comma == std::string_view::npos) != (i + 1 == parts.size())) return refused();
        std::string_view part = value.substr(0, comma);
        while (part.starts_with(' ')) part.remove_prefix(1);
        const auto number = number_in(part, i == 0 ? 1 : 0, most[i]);
        if (!number) return refused();
        parts[i] = *number;
        if (comma != std::string_view::npos) value.remove_prefix(comma + 1);
    }
    const auto [least, near, far] = parts;
    if (far < near + least) return refused();
    setup.layer_least = least;
    setup.layer_near = near;
    setup.layer_far = far;
    return done();
}

/// "00:00:00.50" of TE, "00:00.50" of TP: two digits with one character between them.
Reply set_interval(std::string_view value, Setup& setup) {
    double seconds = 0;
    std::size_t at = 0;
    for (; at + 2 <= value.size(); at += 3) {
        if (!are_digits(value.substr(at, 2), 2)) return refused();
        const int part = *number_in(value.substr(at, 2), 0, 99);
        const bool hundredths = at > 0 && value[at - 1] == '.';
        seconds = hundredths ? seconds + 0.01 * part : 60 * seconds + part;
    }
    if (at != value.size() + 1 || value.size() < 8 || seconds > 86400) return refused();
    setup.interval = static_cast<int>(100 * seconds + 0.5);
    return done();
}

/// "26/11/27,12:30:15" with any characters between the digits.
Reply set_clock(std::string_view value) {
    std::array<int, 6> parts{};
    if (value.size() < 17) return refused();
    value = value.substr(value.size() - 17);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto part = value.substr(3 * i, 2);
        if (!are_digits(part, 2)) return refused();
        parts[i] = *number_in(part, 0, 99);
    }
    using namespace std::chrono;
    const year_month_day date{year(2000 + parts[0]), month(static_cast<unsigned>(parts[1])),
                              day(static_cast<unsigned>(parts[2]))};
    if (!date.ok() || parts[3] > 23 || parts[4] > 59 || parts[5] > 59) return refused();
    const auto at = sys_days(date) + hours(parts[3]) + minutes(parts[4]) + seconds(parts[5]);
    Reply reply = done();
    reply.clock = duration_cast<microseconds>(at.time_since_epoch()).count();
    return reply;
}

std::string clock_text(std::int64_t now) {
    const auto moment = doppler::moment_of(now);
    char text[32];
    std::snprintf(text, sizeof text, "%02d/%02d/%02d,%02d:%02d:%02d", moment.year() % 100, moment.month(),
                  moment.day(), moment.hour(), moment.minute(), moment.second());
    return text;
}

std::string layer_text(const Setup& setup) {
    char text[80];
    std::snprintf(text, sizeof text, "BL = %d, %d, %d ---------- WMass Params [min, near, far (dm)]",
                  setup.layer_least, setup.layer_near, setup.layer_far);
    return text;
}

std::string state_of(const Whole& row, const Setup& setup) {
    char value[16];
    std::snprintf(value, sizeof value, row.form, setup.*row.member);
    return std::string(row.name) + " = " + value + " --------------- " + std::string(row.help);
}

std::string system_text(const Settings& settings) {
    char text[400];
    std::snprintf(
        text, sizeof text,
        "    Serial Number:  %u\r\n        Frequency:  %.0f HZ\r\n    Configuration:  4 BEAM, JANUS\r\n"
        "  Transducer Type:  PHASED ARRAY\r\n       Beam Angle:  %.0f DEGREES\r\n     CPU Firmware:  "
        "%d.%02d",
        unsigned{settings.serial_number}, settings.acoustics.frequency, rad_to_deg(settings.acoustics.tilt),
        settings.series->firmware, settings.series->revision);
    return text;
}

}  // namespace

Reply obey(std::string_view line, Setup& setup, const Settings& settings, std::int64_t now) {
    while (line.ends_with(' ')) line.remove_suffix(1);
    if (line.empty()) return done();
    std::string upper(line);
    for (char& c : upper)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    if (upper == "?") return told("Available Commands:  B C E P T W #P OL");
    for (const char* name : {"#PD", "#BK", "#BL"})
        if (upper.starts_with(name)) upper.erase(0, 1);
    const std::string_view all = upper, name = all.substr(0, 2);
    std::string_view value = all.substr(std::min<std::size_t>(all.size(), 2));
    while (value.starts_with(' ')) value.remove_prefix(1);
    const bool asks = value == "?";
    if (name == "CS" && value.empty()) return {.start = true};
    if (name == "CK" && value.empty()) return told("[Parameters saved as USER defaults]");
    if (name == "CR" && (value == "0" || value == "1")) {
        setup = value == "1" ? Setup{} : settings.start;
        return told(value == "1" ? "[Parameters set to FACTORY defaults]"
                                 : "[Parameters set to USER defaults]");
    }
    if (name == "CZ" && value.empty()) return {.wake = true};
    if (name == "EX" && !asks) return set_frame(value, setup);
    if (name == "CF" && !asks) return set_flow(value, setup);
    if (name == "PD" && !asks) return set_format(value, setup);
    if (name == "BL") return asks ? told(layer_text(setup)) : set_layer(value, setup);
    if (name == "PS") return value == "0" ? told(system_text(settings)) : refused();
    if (name == "PA" && value.empty()) return told("Built-in tests\r\n    All tests ... PASS");
    if ((name == "TE" || name == "TP") && !asks) return set_interval(value, setup);
    if (name == "TS" || name == "TT")
        return asks ? told(std::string(name) + " = " + clock_text(now)) : set_clock(value);
    for (const Whole& row : wholes) {
        if (row.name != name) continue;
        if (asks) return told(state_of(row, setup));
        const auto number = number_in(value, row.low, row.high);
        if (!number) return refused();
        setup.*row.member = *number;
        return done();
    }
    const bool plain = value.find_first_not_of("0123456789+-., ") == std::string_view::npos;
    const bool known = std::ranges::find(idle, name) != idle.end();
    return known && plain && !value.empty() ? done() : refused();
}

std::string banner(const Settings& settings) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "\r\n%s\r\nTeledyne RD Instruments (c) 2017\r\nAll rights reserved.\r\n"
                  "Firmware Version: %d.%02d\r\n\r\n>",
                  std::string(settings.series->banner).c_str(), settings.series->firmware,
                  settings.series->revision);
    return text;
}

}  // namespace echoloop::teledyne_dvl
