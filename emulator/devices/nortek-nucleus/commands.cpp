#include "emulator/devices/nortek-nucleus/commands.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>

#include "emulator/devices/family/doppler/moment.h"

namespace echoloop::nortek_nucleus {
namespace {

/// Of one key of a group: the words that it may have, or the numbers.
struct Row {
    std::string_view group, key, start;
    std::string_view words{};  ///< with commas behind each; none: a number
    double low = 0, high = 0;
};
constexpr std::string_view on_off = "\"ON\",\"OFF\",";
// Keys and words: those that the maker's driver sends. Bounds that it does not have, and what is set at the
// start, are own choices, but for FREQ of TRIG.
constexpr std::array rows{
    Row{"INST", "TYPE", "\"NAV\"", "\"SENSORS\",\"NAV\","},
    Row{"INST", "ROTXY", "0", "", -180, 180},
    Row{"INST", "ROTYZ", "0", "", -180, 180},
    Row{"INST", "ROTXZ", "0", "", -180, 180},
    Row{"INST", "LED", "\"ON\"", on_off},
    Row{"AHRS", "FREQ", "10", "", 1, 100},
    Row{"AHRS", "MODE", "0", "", 0, 4},
    Row{"AHRS", "DS", "\"ON\"", on_off},
    Row{"AHRS", "DF", "210", "", 0, 255},
    Row{"BT", "MODE", "\"AUTO\"", "\"FAST_ACQ\",\"AUTO\",\"CRAWLER\","},
    Row{"BT", "VR", "5", "", 0, 10},
    Row{"BT", "WT", "\"OFF\"", on_off},
    Row{"BT", "PL", "0", "", -100, 0},
    Row{"BT", "PLMODE", "\"MAX\"", "\"MAX\",\"USER\","},
    Row{"BT", "DS", "\"ON\"", on_off},
    Row{"BT", "DF", "180", "", 0, 255},
    Row{"ALTI", "PL", "0", "", -100, 0},
    Row{"ALTI", "DS", "\"ON\"", on_off},
    Row{"ALTI", "DF", "170", "", 0, 255},
    Row{"TRIG", "SRC", "\"INTERNAL\"", "\"INTERNAL\",\"EXTRISE\",\"EXTFALL\",\"EXTEDGES\",\"COMMAND\","},
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
    Row{"MAG", "METHOD", "\"AUTO\"", "\"AUTO\",\"OFF\",\"WMM\","},
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

std::optional<double> number_in(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size() && !text.empty();
    return whole ? std::optional(value) : std::nullopt;
}

bool is_legal(const Row& row, const std::string& value) {
    if (!row.words.empty())
        return value.size() > 2 && value.find(',') == std::string::npos &&
               row.words.find(value + ',') != std::string_view::npos;
    const auto number = number_in(value);
    return number && *number >= row.low && *number <= row.high;
}

const Row* row_of(std::string_view group, std::string_view key) {
    const auto* found =
        std::ranges::find_if(rows, [&](const Row& r) { return r.group == group && r.key == key; });
    return found == rows.end() ? nullptr : found;
}

bool is_group(std::string_view name) { return std::ranges::find(rows, name, &Row::group) != rows.end(); }

std::vector<std::string> split(std::string_view text) {
    std::vector<std::string> parts{""};
    bool quoted = false;
    for (const char c : text) {
        quoted = quoted != (c == '"');
        if (c == ',' && !quoted)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

std::string sum_of(std::string_view body) {
    unsigned sum = 0;
    for (const char c : body) sum ^= static_cast<unsigned char>(c);
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02X", sum & 0xFF);
    return digits;
}

/// One line of an answer.
std::string ended(const std::string& line, bool sentence) {
    if (!sentence) return line + "\r\n";
    const std::string body = "PNOR," + line;
    return '$' + body + '*' + sum_of(body) + "\r\n";
}

std::string group_line(std::string_view name, std::string_view group, const Setup& setup) {
    std::string line(name);
    for (const Row& row : rows)
        if (row.group == group)
            line += ',' + std::string(row.key) + '=' +
                    setup.find(group)->second.find(std::string(row.key))->second;
    return line;
}

/// "2026-11-27 12:30:15" in quotes.
std::optional<std::int64_t> clock_in(std::string_view text) {
    std::array<int, 6> parts{};
    constexpr std::array<std::pair<std::size_t, std::size_t>, 6> places{
        {{1, 4}, {6, 2}, {9, 2}, {12, 2}, {15, 2}, {18, 2}}};
    if (text.size() != 21) return std::nullopt;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto number = number_in(text.substr(places[i].first, places[i].second));
        if (!number || *number < 0) return std::nullopt;
        parts[i] = static_cast<int>(*number);
    }
    using namespace std::chrono;
    const year_month_day date{year(parts[0]), month(static_cast<unsigned>(parts[1])),
                              day(static_cast<unsigned>(parts[2]))};
    if (!date.ok() || parts[0] < 1970 || parts[3] > 23 || parts[4] > 59 || parts[5] > 59) return std::nullopt;
    const auto at = sys_days(date) + hours(parts[3]) + minutes(parts[4]) + seconds(parts[5]);
    return duration_cast<microseconds>(at.time_since_epoch()).count();
}

std::string clock_line(std::int64_t now) {
    const auto m = doppler::moment_of(now);
    char text[64];
    std::snprintf(text, sizeof text, "GETCLOCKSTR,TIME=\"%04d-%02d-%02d %02d:%02d:%02d\"", m.year(),
                  m.month(), m.day(), m.hour(), m.minute(), m.second());
    return text;
}

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
        if (name == "GETCLOCKSTR") return {{clock_line(now_)}};
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
        if (name.starts_with("GET") && name.ends_with("LIM") && is_group(group(name, 3, 3)))
            return {{limits(name, group(name, 3, 3))}};
        if (name.starts_with("GET") && is_group(group(name, 3, 0)))
            return {{group_line(name, group(name, 3, 0), state_.setup)}};
        if (name.starts_with("SET") && is_group(group(name, 3, 0))) return set(group(name, 3, 0), words);
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
    std::string id_line() const {
        return "ID,STR=\"Nucleus1000\",SN=" + std::to_string(settings_.serial_number);
    }
    Lines all() const {
        std::vector<std::string> lines{id_line(), "GETFW,STR=\"4.0.0\"",
                                       "GETHW,DIGITAL=\"A-0\",ANALOG=\"A-0\"", clock_line(now_)};
        for (const auto& [name, keys] : state_.setup)
            lines.push_back(group_line("SET" + name, name, state_.setup));
        lines.push_back("GETERROR,STR=\"" + state_.error + '"');
        return lines;
    }
    static std::string limits(const std::string& name, const std::string& of) {
        std::string line = name;
        char numbers[64];
        for (const Row& row : rows) {
            if (row.group != of) continue;
            std::snprintf(numbers, sizeof numbers, "([%g;%g])", row.low, row.high);
            std::string words(row.words.substr(0, row.words.empty() ? 0 : row.words.size() - 1));
            std::ranges::replace(words, ',', ';');
            line += ',' + std::string(row.key) + '=' + (words.empty() ? numbers : '[' + words + ']');
        }
        return line;
    }
    /// All or nothing.
    Lines set(const std::string& of, const std::vector<std::string>& words) {
        auto changed = state_.setup[of];
        for (std::size_t i = 1; i < words.size(); ++i) {
            const std::size_t equals = words[i].find('=');
            const std::string key = words[i].substr(0, equals);
            const Row* row = row_of(of, key);
            if (row == nullptr || equals == std::string::npos) return refuse("Unknown parameter " + key);
            const std::string value = words[i].substr(equals + 1);
            if (!is_legal(*row, value)) return refuse("Invalid value of " + key);
            changed[key] = value;
        }
        state_.setup[of] = changed;
        return std::vector<std::string>{};
    }

    State& state_;
    const Settings& settings_;
    Answer& out_;
    std::int64_t now_;
};

}  // namespace

Setup default_setup() {
    Setup setup;
    for (const Row& row : rows) setup[std::string(row.group)][std::string(row.key)] = row.start;
    return setup;
}

double number_of(const Setup& setup, std::string_view group, std::string_view key, double otherwise) {
    const auto keys = setup.find(group);
    if (keys == setup.end()) return otherwise;
    const auto found = keys->second.find(std::string(key));
    return found == keys->second.end() ? otherwise : number_in(found->second).value_or(otherwise);
}

bool is_on(const Setup& setup, std::string_view group) {
    const auto keys = setup.find(group);
    if (keys == setup.end()) return false;
    const auto found = keys->second.find("DS");
    return found != keys->second.end() && found->second == "\"ON\"";
}

Answer answer(std::string_view line, State& state, const Settings& settings, std::int64_t now) {
    Answer out;
    const bool sentence = line.starts_with("$PNOR,");
    bool sound = true;
    if (sentence) {
        const std::size_t star = line.rfind('*');
        const std::string_view body = line.substr(1, star == std::string_view::npos ? star : star - 1);
        sound = star != std::string_view::npos && line.substr(star + 1) == sum_of(body);
        line = body.substr(5);
    }
    std::string upper(line);
    bool quoted = false;
    for (char& c : upper) {
        quoted = quoted != (c == '"');
        if (!quoted && c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    if (!sound) state.error = "Invalid checksum";
    const Lines lines = sound ? Command(state, settings, out, now).obey(split(upper)) : std::nullopt;
    out.good = lines.has_value();
    if (lines)
        for (const std::string& one : *lines) out.text += ended(one, sentence);
    out.text += ended(lines ? "OK" : "ERROR", sentence);
    return out;
}

}  // namespace echoloop::nortek_nucleus
