#include "emulator/devices/norbit-wbms/controls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <utility>

namespace echoloop::norbit_device {
namespace {

/// How an answer writes a number: as short as it can be, with a decimal at least, or three wide. Only whole
/// ones are taken as `whole`.
enum class Form { shortest, whole, decimal, padded };
using enum Form;

struct Argument {
    double Controls::*member = nullptr;
    double low = 0, high = 0;
    Form form = shortest;
};

/// A command that sets numbers. Bounds are the document's unless a comment says otherwise.
struct Row {
    std::string_view name;
    std::vector<Argument> arguments;
    std::string_view comment;
    std::vector<std::string_view> meanings{};  ///< comments for values 0, 1, ... instead
    std::string_view answered{};               ///< the name in answers, which is a command as well
};

using C = Controls;

/// The document shows its answer, which is a sentence.
constexpr std::string_view depth_range = "depth_range";

/// What is in the pictures of TN-180197 is answered as there: decimals, some comments, names without "set_".
const std::vector<Row>& rows() {
    static const std::vector<Row> table{
        {"set_power", {{&C::power, 0, 1, whole}}, ""},
        {"set_mode", {{&C::mode, 0, 1, whole}}, "", {"Forward", "Bathy"}},  // others are not emulated
        {"set_flip", {{&C::flip, 0, 1, whole}}, ""},
        {"set_gate_mode",
         {{&C::gate_mode, 0, 2, whole}},
         "",
         {"gate by range", "gate by depth", "gate by range and depth"}},
        {"set_gate_tilt", {{&C::gate_tilt, -45, 45, decimal}}, "in degrees"},
        {"set_range", {{&C::start, 0, 600, decimal}, {&C::stop, 0, 600, decimal}}, "in meter", {}, "range"},
        {"set_range",
         {{&C::range_start, 0, 600, decimal},
          {&C::range_stop, 0, 600, decimal},
          {&C::depth_start, 0, 600, decimal},
          {&C::depth_stop, 0, 600, decimal}},
         "in meter",
         {},
         "range"},
        {depth_range, {{&C::start, 0, 600, decimal}, {&C::stop, 0, 600, decimal}}, ""},
        {"set_direction", {{&C::direction, -90, 90, decimal}}, "in degrees", {}, "direction"},
        {"set_opening_angle", {{&C::opening, 0, 360, decimal}}, "in degrees"},
        {"set_resolution",
         {{&C::vertical_resolution, 64, 2048, whole}, {&C::horizontal_resolution, 64, 512, whole}},
         ""},
        {"set_tx_direction", {{&C::tx_direction, -90, 90, decimal}}, "in degrees"},
        {"set_tx_opening_angle", {{&C::tx_opening, 0, 90, decimal}}, "in degrees"},
        {"set_tx_beam_number", {{&C::tx_beams, 1, 64, whole}}, ""},
        {"set_mf_decimation", {{&C::decimation, 1, 16, whole}}, ""},
        {"set_tx",
         {{&C::frequency, 80, 1000},
          {&C::bandwidth, 0, 80},
          {&C::amplitude, 0, 15, whole},
          {&C::pulse, 10, 819}},
         "kHz, kHz, 0-15, us"},
        {"set_rate", {{&C::rate, -1, 60}}, "Hz, -1 automatic"},
        {"set_tp_rate", {{&C::image_rate, -1, 60}}, "Hz, -1 every ping"},
        {"set_vga", {{&C::vga, 0, 100}}, "dB/100 m, 0 off"},
        {"set_gain", {{&C::gain, 0, 100, padded}}, ""},  // its comment: see comment_of()
        {"autogain", {{&C::autogain, 0, 2, whole}}, "", {"locked", "adaptive", "fixed"}},
        {"set_snippet_rate", {{&C::snippet_rate, -1, 60}}, "Hz"},
        {"set_trigger_mode", {{&C::trigger_mode, 0, 5, whole}}, ""},
        {"set_sidescan_mode", {{&C::sidescan_mode, 0, 9, whole}}, ""},
        {"set_autogate_preset", {{&C::autogate, 0, 3, whole}}, ""},
        {"sound_velocity", {{&C::sound_velocity, -1, 1700}}, "m/s, -1 probe"},
        {"set_time_source", {{&C::time_source, 0, 8, whole}}, ""},
    };
    return table;
}

/// The row of a command; of several the one with as many arguments, or that the gate mode asks for.
const Row* find_row(const norbit::Command& command, const Controls& controls) {
    const std::size_t given = command.arguments.size();
    const std::size_t wanted = given > 0 ? given : controls.gate_mode == 2 ? 4 : 2;
    const Row* found = nullptr;
    for (const Row& row : rows()) {
        const bool is_named =
            command.name == row.name || (command.name == row.answered && !command.name.empty());
        if (is_named && (found == nullptr || row.arguments.size() == wanted)) found = &row;
    }
    return found;
}

/// What bounds of single numbers do not say.
bool makes_sense(const Controls& c) {
    constexpr std::array<double, 4> columns{64, 128, 256, 512};
    constexpr double slowest_rate = 0.001;  // Hz; own choice. What is not positive is automatic
    const auto is_rate = [](double rate) { return rate <= 0 || rate >= slowest_rate; };
    return c.start < c.stop && c.range_start < c.range_stop && c.depth_start < c.depth_stop &&
           std::find(columns.begin(), columns.end(), c.horizontal_resolution) != columns.end() &&
           (c.sound_velocity == -1 || c.sound_velocity >= 1300) && is_rate(c.rate) && is_rate(c.image_rate);
}

/// False, and nothing set, if a word does not fit.
bool set(const Row& row, const std::vector<std::string>& words, Controls& controls) {
    if (words.size() != row.arguments.size()) return false;
    Controls wanted = controls;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto& [member, low, high, form] = row.arguments[i];
        const auto value = norbit::read_number(words[i]);
        if (!value || *value < low || *value > high) return false;
        if (form == whole && *value != std::floor(*value)) return false;
        wanted.*member = *value;
    }
    if (!makes_sense(wanted)) return false;
    controls = wanted;
    return true;
}

std::string write_value(double value, Form form) {
    if (form == decimal) return norbit::write_decimal(value);
    const std::string text = norbit::write_number(value);
    constexpr std::size_t width = 3;
    return form == padded && text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string comment_of(const Row& row, const Controls& controls) {
    const Argument& first = row.arguments.front();
    if (!row.meanings.empty())
        return std::string(row.meanings[static_cast<std::size_t>(controls.*first.member)]);
    if (first.member != &C::gain) return std::string(row.comment);
    char text[40];  // the picture ends behind "digi", so nothing follows here
    std::snprintf(text, sizeof text, "dB (analog = %fdB)", std::min(controls.gain, largest_analog_gain));
    return text;
}

Reply answer_row(const Row& row, const norbit::Command& command, Controls& controls) {
    const bool fits = command.arguments.empty() || set(row, command.arguments, controls);
    const std::string comment = fits ? comment_of(row, controls) : "out of range, not set";
    std::vector<std::string> values;
    for (const auto& [member, low, high, form] : row.arguments)
        values.push_back(write_value(controls.*member, form));
    if (row.name == depth_range)
        return {norbit::write_answer({"Bottom", {"detect", "gates", "set:", values[0], "to", values[1], "m"}},
                                     comment),
                fits};
    const std::string_view name = row.answered.empty() ? row.name : row.answered;
    return {norbit::write_answer({std::string(name), std::move(values)}, comment), fits};
}

/// Commands that set no number of their own; empty if it is none of them.
std::string answer_other(const norbit::Command& command, Controls& controls, const Settings& settings,
                         Time now) {
    const auto say = [&](const std::string& word, std::string_view comment = {}) {
        return norbit::write_answer({command.name, {word}}, comment);
    };
    if (command.name == "temperature") {
        const double read =
            settings.sensors.read("board", settings.temperature, stray::board_temperature, now);
        return say(norbit::write_number(read), "in celsius");
    }
    if (command.name == "revision") return say(settings.revision);
    if (command.name == "serial") return say(settings.serial);
    if (command.name == "partno") return say(settings.part_number);
    if (command.name == "set_ntp_server" && command.arguments.size() <= 1) {
        if (!command.arguments.empty()) controls.time_server = command.arguments[0];
        return say(controls.time_server);
    }
    if (command.name == "on" || command.name == "off") {
        controls.power = command.name == "on" ? 1 : 0;
        return norbit::write_answer({command.name, {}});
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

Reply obey(const norbit::Command& command, Controls& controls, const Settings& settings, Time now) {
    if (const Row* row = find_row(command, controls)) return answer_row(*row, command, controls);
    std::string text = answer_other(command, controls, settings, now);
    if (!text.empty()) return {std::move(text), true};
    return {norbit::write_answer({"error", {}}, "unknown command"), false};
}

}  // namespace echoloop::norbit_device
