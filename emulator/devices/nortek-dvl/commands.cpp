#include "emulator/devices/nortek-dvl/commands.h"

#include <array>
#include <cstdio>

#include "emulator/devices/family/nortek/lines.h"

namespace echoloop::nortek_dvl {
namespace {

using nortek_console::any_text;
using nortek_console::on_off;
using nortek_console::Row;

constexpr std::string_view triggers =
    "\"INTSR\",\"COMMAND\",\"SERIAL\",\"TTLRISE\",\"TTLFALL\",\"TTLEDGES\",\"RS485RISE\",\"RS485FALL\","
    "\"RS485EDGES\"";
// Keys: those of public configurations. Words of DF and WTDF: pynmea2. Words of TRIG: the manuals and DUNE;
// those of edges other than TTLRISE are made likewise. Bounds: SR is the manual's, the others are own
// choices. What is set at the start: the options', and own choices.
constexpr std::array command_rows{Row{"DVL", "CP", "0", "", 0, 1000},
                                  Row{"DVL", "TRIG", "\"INTSR\"", triggers},
                                  Row{"DVL", "SR", "4", "", 1, 8},
                                  Row{"DVL", "FN", "\"\"", any_text},
                                  Row{"DVL", "SV", "1500", "", 1300, 1700, true},
                                  Row{"DVL", "SA", "35", "", 0, 50},
                                  Row{"DVL", "ALTI", "0", "", 0, 1000},
                                  Row{"BT", "RANGE", "300", "", 1, 300},
                                  Row{"BT", "VR", "5", "", 0.5, 10},
                                  Row{"BT", "NB", "4", "", 1, 4},
                                  Row{"BT", "CH", "0", "", 0, 4321},
                                  Row{"BT", "DF", "21", "21,350,351,354,355,356,357,358,359"},
                                  Row{"BT", "PL", "0", "", -20, 0},
                                  Row{"BT", "CY", "\"XYZ\"", "\"XYZ\",\"BEAM\""},
                                  Row{"BT", "WT", "\"OFF\"", on_off},
                                  Row{"BT", "WTDF", "22", "22,404,405,406,407,408,409"},
                                  Row{"BT", "BD", "0.01", "", 0, 20},
                                  Row{"BT", "PLMODE", "\"USER\"", "\"MAX\",\"USER\""},
                                  Row{"INST", "LED", "\"ON\"", "\"ON\",\"ON24H\",\"OFF\""}};
constexpr nortek_console::Table command_table{command_rows};

// Of values without a key. Older firmware has a word between CP and TRIG, as DUNE sends it.
constexpr std::array<std::string_view, 7> older_dvl{"CP", "", "TRIG", "SR", "FN", "SV", "SA"},
    newer_dvl{"CP", "TRIG", "SR", "FN", "SV", "SA", "ALTI"},
    bt_order{"RANGE", "VR", "NB", "CH", "DF", "PL", "CY"};

std::span<const std::string_view> order_of(const std::string& group, const std::vector<std::string>& words) {
    if (group == "BT") return bt_order;
    if (group != "DVL") return {};
    const bool older = words.size() > 2 && (words[2] == "\"OFF\"" || words[2] == "\"ON\"");
    return older ? older_dvl : newer_dvl;
}

constexpr std::array<std::string_view, 6> clock_keys{"YEAR", "MONTH", "DAY", "HOUR", "MINUTE", "SECOND"};

/// What a command says before OK; nothing: it is refused.
using Told = std::optional<std::vector<std::string>>;
Told nothing_but_ok() { return std::vector<std::string>{}; }

class Interpreter {
  public:
    Interpreter(State& state, const Settings& settings, Answer& out, std::int64_t now)
        : state_(state), settings_(settings), out_(out), now_(now) {}

    Told obey(const std::vector<std::string>& words) {
        const std::string& name = words[0];
        if (Told told = mode_command(name)) return told;
        if (Told told = tell(name, words)) return told;
        if (state_.mode != Mode::command && changes(name))
            return refuse("Only in command mode: send a break, then MC");
        if (name == "START") return change_to(Mode::measuring);
        if (name == "SETCLOCKSTR") return set_clock_text(words);
        if (name == "SETCLOCK") return set_clock(words);
        if (name == "SAVE" || name == "REBOOT" || name == "POWERDOWN") return nothing_but_ok();
        if (name == "SETDEFAULT") {
            state_.setup = default_setup(settings_);
            return nothing_but_ok();
        }
        if (name.starts_with("SET") && command_table.has(name.substr(3))) return set(name.substr(3), words);
        return refuse(name == "TRIG" ? "Not triggered by command" : "Unknown command");
    }

  private:
    static bool changes(const std::string& name) {
        return name == "START" || name == "SAVE" || name == "REBOOT" || name == "POWERDOWN" ||
               name.starts_with("SET");
    }
    Told refuse(const std::string& why) {
        state_.error = why;
        return std::nullopt;
    }
    Told change_to(Mode mode) {
        state_.mode = mode;
        return nothing_but_ok();
    }
    /// Those about its mode, which are taken in other modes too.
    Told mode_command(const std::string& name) {
        if (name == "MC" && state_.mode != Mode::measuring) return change_to(Mode::command);
        if (name == "CO" && state_.mode == Mode::confirmation) return change_to(Mode::measuring);
        if (name == "RM" && state_.mode == Mode::command) return nothing_but_ok();
        if (name == "BBPWAKEUP") return nothing_but_ok();
        const Trigger trigger = trigger_of(state_.setup);
        if (name != "TRIG" || state_.mode != Mode::measuring || trigger != Trigger::command)
            return std::nullopt;
        out_.trigger = true;
        return nothing_but_ok();
    }
    /// Those that change nothing.
    Told tell(const std::string& name, const std::vector<std::string>& words) const {
        constexpr std::array<std::string_view, 3> modes{"COMMAND", "MEASUREMENT", "CONFIRMATION"};
        const std::string mode(modes[static_cast<std::size_t>(state_.mode)]);
        if (name == "ID") return {{id_line()}};
        if (name == "INQ") return {{mode}};
        if (name == "GETSTATE") return {{"GETSTATE,MODE=\"" + mode + '"'}};
        if (name == "GETFW") return {{"GETFW,STR=\"2202_6\""}};
        if (name == "GETHW") return {{"GETHW,DIGITAL=\"A-0\",ANALOG=\"A-0\""}};
        if (name == "GETERROR") return {{state_.error}};
        if (name == "GETCLOCKSTR") return {{"GETCLOCKSTR,TIME=\"" + nortek_console::clock_text(now_) + '"'}};
        if (name == "GETCLOCK") return {{clock_line()}};
        if (name == "GETALL") return all();
        if (!name.starts_with("GET")) return std::nullopt;
        const std::string group = name.substr(3);
        if (command_table.has(group)) return {{command_table.values(name, group, state_.setup, words)}};
        if (!group.ends_with("LIM") || !command_table.has(group.substr(0, group.size() - 3)))
            return std::nullopt;
        return {{command_table.limits(name, group.substr(0, group.size() - 3), words)}};
    }
    std::string id_line() const {
        return "ID,STR=\"" + settings_.product + "\",SN=" + std::to_string(settings_.serial_number);
    }
    std::string clock_line() const {
        const std::string text = nortek_console::clock_text(now_);
        constexpr std::array<std::pair<std::size_t, std::size_t>, 6> places{
            {{0, 4}, {5, 2}, {8, 2}, {11, 2}, {14, 2}, {17, 2}}};
        std::string line = "GETCLOCK";
        for (std::size_t i = 0; i < places.size(); ++i)
            line += ',' + std::string(clock_keys[i]) + '=' +
                    std::to_string(std::stoi(text.substr(places[i].first, places[i].second)));
        return line;
    }
    std::vector<std::string> all() const {
        std::vector<std::string> lines{id_line(), "GETFW,STR=\"2202_6\"", clock_line()};
        for (const auto& [group, keys] : state_.setup)
            lines.push_back(command_table.values("SET" + group, group, state_.setup));
        return lines;
    }
    Told set_clock_text(const std::vector<std::string>& words) {
        const bool has = words.size() == 2 && words[1].starts_with("TIME=");
        out_.clock = has ? nortek_console::clock_in(std::string_view(words[1]).substr(5)) : std::nullopt;
        return out_.clock ? nothing_but_ok() : refuse("Invalid time");
    }
    /// YEAR=2026,MONTH=11 and so on, in any order, each once.
    Told set_clock(const std::vector<std::string>& words) {
        std::array<int, clock_keys.size()> parts{};
        std::size_t found = 0;
        for (std::size_t i = 0; i < clock_keys.size(); ++i)
            for (const std::string& word : words)
                if (word.starts_with(std::string(clock_keys[i]) + '=')) {
                    const auto number =
                        nortek_console::number_in(std::string_view(word).substr(clock_keys[i].size() + 1));
                    parts[i] = number && *number >= 0 && *number < 10000 ? static_cast<int>(*number) : -1;
                    ++found;
                }
        const bool whole = found == clock_keys.size() && words.size() == found + 1;
        out_.clock =
            whole ? nortek_console::clock_of(parts[0], parts[1], parts[2], parts[3], parts[4], parts[5])
                  : std::nullopt;
        return out_.clock ? nothing_but_ok() : refuse("Invalid time");
    }
    Told set(const std::string& group, const std::vector<std::string>& words) {
        const auto wrong = command_table.set(state_.setup, group, words, order_of(group, words));
        return wrong ? refuse(*wrong) : nothing_but_ok();
    }

    State& state_;
    const Settings& settings_;
    Answer& out_;
    std::int64_t now_;
};

std::string short_number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", value);
    return text.data();
}

}  // namespace

Setup default_setup(const Settings& s) {
    constexpr std::array<std::string_view, 5> words{"INTSR", "COMMAND", "TTLRISE", "TTLFALL", "TTLEDGES"};
    Setup setup = command_table.start();
    auto& dvl = setup["DVL"];
    dvl["TRIG"] = '"' + std::string(words[static_cast<std::size_t>(s.trigger)]) + '"';
    dvl["SR"] = short_number(s.rate);
    dvl["SV"] = short_number(s.sound_speed);
    dvl["SA"] = short_number(s.salinity);
    auto& bottom = setup["BT"];
    bottom["RANGE"] = short_number(s.acoustics.highest_altitude);
    bottom["VR"] = short_number(s.acoustics.fastest);
    bottom["DF"] = std::to_string(s.bottom_format);
    bottom["WT"] = s.water_track ? "\"ON\"" : "\"OFF\"";
    bottom["WTDF"] = std::to_string(s.water_format);
    return setup;
}

Trigger trigger_of(const Setup& setup) {
    const std::string word = nortek_console::value_of(setup, "DVL", "TRIG");
    if (word.ends_with("RISE\"")) return Trigger::rise;
    if (word.ends_with("FALL\"")) return Trigger::fall;
    if (word.ends_with("EDGES\"")) return Trigger::edges;
    return word == "\"INTSR\"" ? Trigger::internal : Trigger::command;
}

bool tracks_water(const Setup& setup) { return nortek_console::value_of(setup, "BT", "WT") == "\"ON\""; }

Answer answer(std::string_view line, State& state, const Settings& settings, std::int64_t now) {
    Answer out;
    const nortek_console::Words words = nortek_console::read_words(line);
    if (!words.sound) state.error = "Invalid checksum";
    const Told told = words.sound ? Interpreter(state, settings, out, now).obey(words.all) : std::nullopt;
    out.good = told.has_value();
    if (told)
        for (const std::string& one : *told) out.text += nortek_console::ended(one, words.sentence);
    out.text += nortek_console::ended(told ? "OK" : "ERROR", words.sentence);
    return out;
}

Answer answer_break(State& state, const Settings& settings) {
    state.mode = state.mode == Mode::command ? Mode::command : Mode::confirmation;
    state.broke = true;
    return {"NortekDVL - NORTEK AS.\r\nVersion 2202_6\r\n" + settings.product + ' ' +
            std::to_string(settings.serial_number) + "\r\nOK\r\n"};
}

}  // namespace echoloop::nortek_dvl
