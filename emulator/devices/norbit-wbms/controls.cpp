#include "emulator/devices/norbit-wbms/controls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

namespace echoloop::norbit_device {
namespace {

struct Argument {
    double Controls::*member = nullptr;
    double low = 0, high = 0;
    bool whole = false;
};

/// A command that sets numbers. Bounds are the document's unless a comment says otherwise.
struct Row {
    std::string_view name;
    std::vector<Argument> arguments;
    std::string_view comment;
};

using C = Controls;

const std::vector<Row>& rows() {
    static const std::vector<Row> table{
        {"set_power", {{&C::power, 0, 1, true}}, ""},
        {"set_mode", {{&C::mode, 0, 1, true}}, "0 forward, 1 bathymetry"},  // others are not emulated
        {"set_flip", {{&C::flip, 0, 1, true}}, ""},
        {"set_gate_mode", {{&C::gate_mode, 0, 2, true}}, "0 range, 1 depth, 2 both"},
        {"set_gate_tilt", {{&C::gate_tilt, -45, 45}}, "in degrees"},
        {"set_range", {{&C::start, 0, 600}, {&C::stop, 0, 600}}, "in meter"},
        {"set_range",
         {{&C::range_start, 0, 600},
          {&C::range_stop, 0, 600},
          {&C::depth_start, 0, 600},
          {&C::depth_stop, 0, 600}},
         "in meter"},
        {"set_direction", {{&C::direction, -90, 90}}, "in degrees"},
        {"set_opening_angle", {{&C::opening, 0, 360}}, "in degrees"},
        {"set_resolution",
         {{&C::vertical_resolution, 64, 2048, true}, {&C::horizontal_resolution, 64, 512, true}},
         ""},
        {"set_tx_direction", {{&C::tx_direction, -90, 90}}, "in degrees"},
        {"set_tx_opening_angle", {{&C::tx_opening, 0, 90}}, "in degrees"},
        {"set_tx_beam_number", {{&C::tx_beams, 1, 64, true}}, ""},
        {"set_mf_decimation", {{&C::decimation, 1, 16, true}}, ""},
        {"set_tx",
         {{&C::frequency, 80, 1000},
          {&C::bandwidth, 0, 80},
          {&C::amplitude, 0, 15, true},
          {&C::pulse, 10, 819}},
         "kHz, kHz, 0-15, us"},
        {"set_rate", {{&C::rate, -1, 60}}, "Hz, -1 automatic"},
        {"set_vga", {{&C::vga, 0, 20000}}, "dB/km, 0 off"},  // own bounds
        {"set_gain", {{&C::gain, 0, 40}}, "dB where vga is 0"},
        {"autogain", {{&C::autogain, 0, 2, true}}, "0 locked, 1 automatic, 2 fixed"},
        {"set_snippet_rate", {{&C::snippet_rate, -1, 60}}, "Hz"},
        {"set_trigger_mode", {{&C::trigger_mode, 0, 5, true}}, ""},
        {"set_sidescan_mode", {{&C::sidescan_mode, 0, 9, true}}, ""},
        {"set_autogate_preset", {{&C::autogate, 0, 3, true}}, ""},
        {"sound_velocity", {{&C::sound_velocity, -1, 1700}}, "m/s, -1 probe"},
        {"set_time_source", {{&C::time_source, 0, 8, true}}, ""},
    };
    return table;
}

/// The row of a command; of several the one with as many arguments, or that the gate mode asks for.
const Row* find_row(const norbit::Command& command, const Controls& controls) {
    const std::size_t given = command.arguments.size();
    const std::size_t wanted = given > 0 ? given : controls.gate_mode == 2 ? 4 : 2;
    const Row* found = nullptr;
    for (const Row& row : rows())
        if (row.name == command.name && (found == nullptr || row.arguments.size() == wanted)) found = &row;
    return found;
}

/// What bounds of single numbers do not say.
bool makes_sense(const Controls& c) {
    constexpr std::array<double, 4> columns{64, 128, 256, 512};
    constexpr double slowest_rate = 0.001;  // Hz; own choice. What is not positive is automatic
    return c.start < c.stop && c.range_start < c.range_stop && c.depth_start < c.depth_stop &&
           std::find(columns.begin(), columns.end(), c.horizontal_resolution) != columns.end() &&
           (c.sound_velocity == -1 || c.sound_velocity >= 1300) && (c.rate <= 0 || c.rate >= slowest_rate);
}

/// False, and nothing set, if a word does not fit.
bool set(const Row& row, const std::vector<std::string>& words, Controls& controls) {
    if (words.size() != row.arguments.size()) return false;
    Controls wanted = controls;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto& [member, low, high, whole] = row.arguments[i];
        const auto value = norbit::read_number(words[i]);
        if (!value || *value < low || *value > high || (whole && *value != std::floor(*value))) return false;
        wanted.*member = *value;
    }
    if (!makes_sense(wanted)) return false;
    controls = wanted;
    return true;
}

Reply answer_row(const Row& row, const norbit::Command& command, Controls& controls) {
    const bool fits = command.arguments.empty() || set(row, command.arguments, controls);
    norbit::Command answer{command.name, {}};
    for (const Argument& argument : row.arguments)
        answer.arguments.push_back(norbit::write_number(controls.*argument.member));
    return {norbit::write_answer(answer, fits ? row.comment : "out of range, not set"), fits};
}

/// Commands that set no number; empty if it is none of them.
std::string answer_other(const norbit::Command& command, Controls& controls, const Settings& settings) {
    const auto say = [&](const std::string& word, std::string_view comment = {}) {
        return norbit::write_answer({command.name, {word}}, comment);
    };
    if (command.name == "temperature") return say(norbit::write_number(settings.temperature), "in celsius");
    if (command.name == "revision") return say(settings.revision);
    if (command.name == "serial") return say(settings.serial);
    if (command.name == "partno") return say(settings.part_number);
    if (command.name == "set_ntp_server" && command.arguments.size() <= 1) {
        if (!command.arguments.empty()) controls.time_server = command.arguments[0];
        return say(controls.time_server);
    }
    if (command.name == "exit") return norbit::write_answer({command.name, {}}, "goodbye");
    if (command.name != "set_default") return {};
    controls = initial_controls(settings);
    return norbit::write_answer({command.name, {}}, "startup defaults");
}

}  // namespace

Controls initial_controls(const Settings& settings) {
    Controls controls;
    controls.power = settings.power ? 1 : 0;
    if (settings.forward_looking) controls.mode = controls.flip = controls.gate_mode = 0;
    return controls;
}

Reply obey(const norbit::Command& command, Controls& controls, const Settings& settings) {
    if (const Row* row = find_row(command, controls)) return answer_row(*row, command, controls);
    std::string text = answer_other(command, controls, settings);
    if (!text.empty()) return {std::move(text), true};
    return {norbit::write_answer({"error", {}}, "unknown command"), false};
}

}  // namespace echoloop::norbit_device
