#include <array>
#include <charconv>
#include <cstdio>
#include <optional>

#include "emulator/devices/family/waterlinked/clock_text.h"
#include "emulator/devices/waterlinked-dvl/commands.h"

namespace echoloop::waterlinked_dvl {
namespace {

using waterlinked::Sentence;
using Fields = std::vector<std::string>;

constexpr std::string_view done = "wra", refused = "wrn", unknown = "wr?";

std::optional<double> number_of(const std::string& field) {
    double value = 0;
    const auto* end = field.data() + field.size();
    const auto [stop, error] = std::from_chars(field.data(), end, value, std::chars_format::fixed);
    return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

char letter_of(bool yes) { return yes ? 'y' : 'n'; }

/// Sets `member` unless the field is empty; which word is the answer where that cannot be.
std::string_view take_number(const std::string& field, double& member, bool (*fits)(double)) {
    if (field.empty()) return done;
    const auto value = number_of(field);
    if (!value) return unknown;
    if (!fits(*value)) return refused;
    member = *value;
    return done;
}
std::string_view take_letter(const std::string& field, bool& member) {
    if (field.empty()) return done;
    if (field != "y" && field != "n") return refused;
    member = field == "y";
    return done;
}
std::string_view take_mode(const std::string& field, RangeMode& member) {
    if (field.empty()) return done;
    const auto mode = read_range_mode(field);
    if (!mode) return refused;
    member = *mode;
    return done;
}

std::string set_configuration(const Fields& f, State& s) {
    constexpr std::size_t few = 4, all = 6;
    if (f.size() != few && f.size() != all) return std::string(unknown);
    Configuration c = s.configuration;
    std::vector<std::string_view> answers{take_number(f[0], c.speed_of_sound, is_speed_of_sound),
                                          take_number(f[1], c.mounting_rotation_offset, is_rotation),
                                          take_letter(f[2], c.acoustic_enabled),
                                          take_letter(f[3], c.dark_mode_enabled)};
    if (f.size() == all) {
        answers.push_back(take_mode(f[4], c.range_mode));
        answers.push_back(take_letter(f[5], c.periodic_cycling_enabled));
    }
    for (const std::string_view one : answers)
        if (one != done) return std::string(one);
    s.configuration = c;
    return std::string(done);
}

std::string configuration_sentence(const Configuration& c) {
    char text[128];
    std::snprintf(text, sizeof text, "wrc,%.2f,%.2f,%c,%c,%s,%c", c.speed_of_sound,
                  c.mounting_rotation_offset, letter_of(c.acoustic_enabled), letter_of(c.dark_mode_enabled),
                  c.range_mode.text.c_str(), letter_of(c.periodic_cycling_enabled));
    return text;
}

std::string product_sentence(const State& s, const Settings& settings) {
    const std::string name = settings.product == "DVL A50" ? "dvl-a50" : "dvl-a125";
    const std::string address = s.address.empty() ? "" : ',' + s.address;
    return "wrw," + name + ',' + std::string(settings.version()) + ',' + chip_text(settings) + address;
}

std::string choose_output(const Fields& f, State& s) {
    const auto value = f.size() == 1 ? number_of(f[0]) : std::nullopt;
    if (!value) return std::string(unknown);
    for (const SerialOutput output :
         {SerialOutput::off, SerialOutput::v1_and_v2, SerialOutput::pd6, SerialOutput::v2, SerialOutput::pd4})
        if (*value == static_cast<int>(output)) {
            s.output = output;
            return std::string(done);
        }
    return std::string(refused);
}

std::string trigger_ping(State& s) {
    if (s.configuration.acoustic_enabled || s.triggers >= most_triggers) return std::string(refused);
    ++s.triggers;
    return std::string(done);
}

std::string set_server(const Fields& f, State& s) {
    if (f.size() != 1) return std::string(unknown);
    if (!waterlinked_family::is_host(f[0])) return std::string(refused);
    s.ntp_address = f[0];
    return std::string(done);
}

std::string set_clock(const Fields& f, State& s, const Settings& settings) {
    const auto us = f.size() == 1 ? number_of(f[0]) : std::nullopt;
    if (!us) return std::string(unknown);
    if (settings.ntp_reached || *us < 0 || *us > 4e15) return std::string(refused);
    s.clock_error = *us * 1e-6 - s.unix_now;
    return std::string(done);
}

std::string clock_sentence(const State& s, const Settings& settings) {
    char text[64];
    std::snprintf(text, sizeof text, "wrs,%.0f,%c,", 1e6 * (s.unix_now + s.clock_error),
                  letter_of(settings.ntp_reached));
    return text + s.ntp_address + ",0";
}

std::string reply_to(const Sentence& sentence, State& s, const Settings& settings) {
    const Fields& f = sentence.fields;
    const std::string& name = sentence.address;
    const bool clock = settings.level >= Level::v2_7_2;
    if (name == "wcs") return set_configuration(f, s);
    if (name == "wcp") return choose_output(f, s);
    if (clock && name == "wcn") return set_server(f, s);
    if (clock && name == "wcm") return set_clock(f, s, settings);
    if (clock && name == "wcT") return std::string("wrT,") + letter_of(settings.ntp_reached);
    if (!f.empty()) return std::string(unknown);
    if (name == "wcv") return settings.commas_in_version ? "wrv,2,8,0" : "wrv,2.8.0";
    if (name == "wcw") return product_sentence(s, settings);
    if (name == "wcc") return configuration_sentence(s.configuration);
    if (name == "wcx") return trigger_ping(s);
    if (clock && name == "wcN") return "wrN," + s.ntp_address;
    if (clock && name == "wct") return clock_sentence(s, settings);
    if (name != "wcr" && name != "wcg") return std::string(unknown);
    (name == "wcr" ? s.reset : s.calibrate) = true;
    return std::string(done);
}

}  // namespace

Answer answer_sentence(std::string_view line, State& state, const Settings& settings) {
    const auto read = waterlinked::read_sentence(line);
    std::string reply(unknown);
    if (read && !read->checksum_fits())
        reply = "wr!";
    else if (read)
        reply = reply_to(*read, state, settings);
    constexpr double calibration = 5;  // s, own choice, as by JSON
    const bool waits = reply == done && read->address == "wcg";
    return {waterlinked::sentence(reply), reply != unknown && reply != refused && reply != "wr!",
            waits ? calibration : 0};
}

}  // namespace echoloop::waterlinked_dvl
