#include "emulator/devices/nortek-nucleus/commands.h"

#include <array>

#include "emulator/devices/family/nortek/lines.h"

namespace echoloop::nortek_nucleus {
namespace {

using nortek_console::clock_in;
using nortek_console::ended;
using nortek_console::on_off;
using nortek_console::Row;

// Keys and words: those that the maker's driver sends. Bounds that it does not have, and what is set at the
// start, are own choices, but for FREQ of TRIG.
constexpr std::array rows{
    Row{"INST", "TYPE", "\"NAV\"", "\"SENSORS\",\"NAV\""},
    Row{"INST", "ROTXY", "0", "", -180, 180},
    Row{"INST", "ROTYZ", "0", "", -180, 180},
    Row{"INST", "ROTXZ", "0", "", -180, 180},
    Row{"INST", "LED", "\"ON\"", on_off},
    Row{"AHRS", "FREQ", "10", "", 1, 100},
    Row{"AHRS", "MODE", "0", "", 0, 4},
    Row{"AHRS", "DS", "\"ON\"", on_off},
    Row{"AHRS", "DF", "210", "", 0, 255},
    Row{"BT", "MODE", "\"AUTO\"", "\"FAST_ACQ\",\"AUTO\",\"CRAWLER\""},
    Row{"BT", "VR", "5", "", 0, 10},
    Row{"BT", "WT", "\"OFF\"", on_off},
    Row{"BT", "PL", "0", "", -100, 0},
    Row{"BT", "PLMODE", "\"MAX\"", "\"MAX\",\"USER\""},
    Row{"BT", "DS", "\"ON\"", on_off},
    Row{"BT", "DF", "180", "", 0, 255},
    Row{"ALTI", "PL", "0", "", -100, 0},
    Row{"ALTI", "DS", "\"ON\"", on_off},
    Row{"ALTI", "DF", "170", "", 0, 255},
    Row{"TRIG", "SRC", "\"INTERNAL\"", "\"INTERNAL\",\"EXTRISE\",\"EXTFALL\",\"EXTEDGES\",\"COMMAND\""},
    Row{"TRIG", "FREQ", "4", "", 1, 8},
    Row{"TRIG", "ALTI", "2", "", 0, 20},
    Row{"TRIG", "CP", "0", "", 0, 20},
    Row{"CURPROF", "RANGE", "20", "", 0, 100},
    Row{"CURPROF", "CS", "1", "", 0, 10},
    Row{"CURPROF", "BD", "0.2", "", 0, 10},
    Row{"CURPROF", "DS", "\"OFF\"", on_off},
    Row{"CURPROF", "DF", "192", "", 0, 255},
    Row{"IMU", "FREQ", "10", "", 1, 200},
    Row{"IMU", "DS", "\"OFF\"", on_off},
    Row{"IMU", "DF", "130", "", 0, 255},
    Row{"MAG", "METHOD", "\"AUTO\"", "\"AUTO\",\"OFF\",\"WMM\""},
    Row{"NAV", "FREQ", "10", "", 1, 100},
    Row{"NAV", "DS", "\"OFF\"", on_off},
    Row{"NAV", "DF", "220", "", 0, 255},
    Row{"FIELDCAL", "MODE", "0", "", 0, 4},
    Row{"MISSION", "POFF", "9.5", "", 0, 11},
    Row{"MISSION", "LONG", "9999", "", -180, 9999},
    Row{"MISSION", "LAT", "9999", "", -90, 9999},
    Row{"MISSION", "DECL", "0", "", -180, 180},
    Row{"MISSION", "RANGE", "50", "", 0, 200},
    Row{"MISSION", "BD", "0.1", "", 0, 10},
    Row{"MISSION", "SV", "0", "", 0, 2500},
    Row{"MISSION", "SA", "35", "", 0, 50}};

constexpr nortek_console::Table table{rows};

/// What a command says before OK; nothing: it is refused.
using Lines = std::optional<std::vector<std::string>>;

class Command {
  public:
    Command(State& state, const Settings& settings, Answer& out, std::int64_t now)
        : state_(state), settings_(settings), out_(out), now_(now) {}

    Lines obey(const std::vector<std::string>& words) {
        const std::string& name = words[0];
        if (name == "START") return start(true);
        if (name == "STOP") return start(false);
        if (name == "TRIG") return trigger();
        if (name == "SETCLOCKSTR") return set_clock(words);
        if (name == "GETCLOCKSTR") return {{clock_line()}};
        if (name == "ID") return {{id_line()}};
        if (name == "GETFW") return {{"GETFW,STR=\"4.0.0\""}};
        if (name == "GETHW") return {{"GETHW,DIGITAL=\"A-0\",ANALOG=\"A-0\""}};
        if (name == "GETERROR") return {{state_.error}};
        if (name == "GETALL") return all();
        if (name == "SAVE" || name == "REBOOT") return std::vector<std::string>{};
        if (name == "SETDEFAULT") {
            state_.setup = default_setup();
            return std::vector<std::string>{};
        }
        if (name.starts_with("GET") && name.ends_with("LIM") && table.has(group(name, 3, 3)))
            return {{table.limits(name, group(name, 3, 3), words)}};
        if (name.starts_with("GET") && table.has(group(name, 3, 0)))
            return {{table.values(name, group(name, 3, 0), state_.setup, words)}};
        if (name.starts_with("SET") && table.has(group(name, 3, 0))) return set(group(name, 3, 0), words);
        return refuse("Unknown command");
    }

  private:
    static std::string group(const std::string& name, std::size_t before, std::size_t behind) {
        return name.substr(before, name.size() - before - behind);
    }
    Lines refuse(const std::string& why) {
        state_.error = why;
        return std::nullopt;
    }
    Lines start(bool running) {
        if (running == state_.running && running) return refuse("Already measuring");
        state_.running = running;
        return std::vector<std::string>{};
    }
    Lines trigger() {
        if (!state_.running || state_.setup["TRIG"]["SRC"] != "\"COMMAND\"")
            return refuse("Not triggered by command");
        out_.trigger = true;
        return std::vector<std::string>{};
    }
    Lines set_clock(const std::vector<std::string>& words) {
        const bool has = words.size() == 2 && words[1].starts_with("TIME=");
        const auto clock = has ? clock_in(std::string_view(words[1]).substr(5)) : std::nullopt;
        if (!clock) return refuse("Invalid time");
        out_.clock = clock;
        return std::vector<std::string>{};
    }
    std::string clock_line() const { return "GETCLOCKSTR,TIME=\"" + nortek_console::clock_text(now_) + '"'; }
    std::string id_line() const {
        return "ID,STR=\"Nucleus1000\",SN=" + std::to_string(settings_.serial_number);
    }
    Lines all() const {
        std::vector<std::string> lines{id_line(), "GETFW,STR=\"4.0.0\"",
                                       "GETHW,DIGITAL=\"A-0\",ANALOG=\"A-0\"", clock_line()};
        for (const auto& [name, keys] : state_.setup)
            lines.push_back(table.values("SET" + name, name, state_.setup));
        lines.push_back("GETERROR,STR=\"" + state_.error + '"');
        return lines;
    }
    Lines set(const std::string& of, const std::vector<std::string>& words) {
        if (const auto wrong = table.set(state_.setup, of, words)) return refuse(*wrong);
        return std::vector<std::string>{};
    }

    State& state_;
    const Settings& settings_;
    Answer& out_;
    std::int64_t now_;
};

}  // namespace

Setup default_setup() { return table.start(); }

bool is_on(const Setup& setup, std::string_view group) {
    return nortek_console::value_of(setup, group, "DS") == "\"ON\"";
}

Answer answer(std::string_view line, State& state, const Settings& settings, std::int64_t now) {
    Answer out;
    const nortek_console::Words words = nortek_console::read_words(line);
    if (!words.sound) state.error = "Invalid checksum";
    const Lines lines = words.sound ? Command(state, settings, out, now).obey(words.all) : std::nullopt;
    out.good = lines.has_value();
    if (lines)
        for (const std::string& one : *lines) out.text += ended(one, words.sentence);
    out.text += ended(lines ? "OK" : "ERROR", words.sentence);
    return out;
}

}  // namespace echoloop::nortek_nucleus
