#include "emulator/scenario/driver_section.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "emulator/scenario/file.h"
#include "emulator/scenario/yaml.h"

namespace echoloop::scenario {
namespace {

constexpr std::size_t most_lines = 2000;
constexpr Range times_of_run{0, 1e7, "s"};
constexpr Range intervals{0.001, 86400, "s"};
constexpr Range repetitions{1, 1e9, "times"};

/// "42 52 0200": pairs of hexadecimal digits, blanks between them as one likes. Empty: it is something else.
Bytes bytes_of_hex(std::string_view text) {
    Bytes bytes;
    int high = -1;
    for (const char c : text) {
        if (c == ' ' && high < 0) continue;
        const auto byte = static_cast<unsigned char>(c);
        if (std::isxdigit(byte) == 0) return {};
        const int digit = std::isdigit(byte) != 0 ? c - '0' : std::tolower(byte) - 'a' + 10;
        if (high >= 0) bytes.push_back(static_cast<std::uint8_t>(high * 16 + digit));
        high = high < 0 ? digit : -1;
    }
    return high < 0 ? bytes : Bytes{};
}

Time nearest_time(double seconds) { return Time(std::llround(seconds * 1e9)); }

/// Only where a repetition is asked for.
void read_repetition(const Section& line, DriverLine& result, Problems& problems) {
    if (line.get("every") == nullptr) {
        if (const Value* times = line.get("times"))
            problems.add(times->key_place, line.path_of("times") + ": add every: SECONDS, or remove it");
        return;
    }
    result.every = nearest_time(line.number("every", 1, intervals));
    result.times = static_cast<std::uint64_t>(line.number("times", 0, repetitions));
}

class LineReader {
  public:
    LineReader(const ScenarioDevice& device, Problems& problems)
        : ports_(device.model->make(device.config)->ports()), problems_(problems) {}

    void read(const Value& list, const std::string& path, std::vector<DriverLine>& script) {
        if (!list.is_sequence() || list.items.size() > most_lines) {
            problems_.add(list.place, path + ": expected a list of at most " + std::to_string(most_lines) +
                                          " lines, as in [{at: 1, every: 0.5, hex: \"42 52 ...\"}]");
            return;
        }
        for (std::size_t i = 0; i < list.items.size(); ++i)
            read_line(list.items[i], path + "." + std::to_string(i), script);
    }

  private:
    void read_line(const Value& value, const std::string& path, std::vector<DriverLine>& script) {
        const std::size_t before = problems_.count();
        const Section line(&value, path, {"at", "every", "times", "port", "hex", "text"}, problems_);
        if (!value.is_map()) {
            if (value.kind == Value::Kind::null) problems_.add(value.place, path + ": there is nothing");
            return;
        }
        DriverLine result;
        result.at = nearest_time(line.number("at", 0, times_of_run));
        read_repetition(line, result, problems_);
        result.port = read_port(line);
        result.messages = {read_bytes(line)};
        if (problems_.count() == before) script.push_back(std::move(result));
    }

    std::size_t read_port(const Section& line) {
        std::vector<std::string_view> names;
        for (const Port& port : ports_) names.emplace_back(port.name);
        const std::string name = line.word("port", std::string(names.front()), names);
        return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    }

    Bytes read_bytes(const Section& line) {
        const Value *hex = line.get("hex"), *text = line.get("text");
        if ((hex == nullptr) == (text == nullptr)) {
            problems_.add(
                hex == nullptr ? line.place() : hex->key_place,
                line.path_of("hex") + ": a line says either hex: \"42 52 00\" or text: \"$KSSIS,458\\r\\n\"");
            return {};
        }
        if (text != nullptr) {
            const std::string said = line.text("text", "");
            if (said.empty() && text->is_scalar())
                problems_.add(text->place, line.path_of("text") + ": it is empty");
            return {said.begin(), said.end()};
        }
        if (!hex->is_scalar()) return line.text("hex", ""), Bytes{};
        Bytes bytes = bytes_of_hex(hex->text);
        if (bytes.empty())
            problems_.add(hex->place, line.path_of("hex") +
                                          ": expected pairs of hexadecimal digits, as in \"42 52 00\", got " +
                                          in_quotes(hex->text));
        return bytes;
    }

    std::vector<Port> ports_;
    Problems& problems_;
};

/// The lines of a file of their own; its problems name it.
void read_file(const Section& section, const Scenario& scenario, ScenarioDevice& device, Problems& problems) {
    const Value& value = *section.get("driver");
    const auto file = scenario.file.parent_path() / value.text;
    const std::string path = section.path_of("driver");
    if (const auto fault = file_fault(file)) {
        problems.add(value.place,
                     path + ": " + in_quotes(file.string()) + ": " + fault->message +
                         "; a relative path starts at the scenario's folder",
                     fault->kind);
        return;
    }
    Problems own(file.string(), {});
    try {
        LineReader(device, own).read(parse_yaml(read_scenario_file(file)), "driver", device.script);
    } catch (const YamlError& error) {
        own.add(error.place, error.message);
    } catch (const ScenarioError& error) {
        problems.add(value.place, path + ": " + error.what());
    }
    problems.append(own);
}

void read_pings(const Section& section, ScenarioDevice& device, Problems& problems) {
    constexpr std::size_t cycle = 401;  // a full turn of the finest head, and one
    const Section pings(section.get("pings"), section.path_of("pings"), {"at", "interval", "count"},
                        problems);
    const Model& model = *device.model;
    if (model.requests == nullptr) {
        problems.add(
            section.get("pings")->key_place,
            pings.path_of("interval") + ": " + model.name +
                " pings by itself, or its driver has more to say than one request; remove pings, or write "
                "the lines that it says as driver: [{at: 0, hex: \"...\"}]");
        return;
    }
    DriverLine line;
    line.at = nearest_time(pings.number("at", 0, times_of_run));
    line.every = nearest_time(pings.number("interval", 1, intervals));
    line.times = static_cast<std::uint64_t>(pings.number("count", 0, repetitions));
    line.messages = model.requests(device.config, cycle, true);
    std::erase(line.messages, Bytes{});
    device.script.push_back(std::move(line));
}

}  // namespace

void read_driver(const Section& section, const Scenario& scenario, ScenarioDevice& device,
                 Problems& problems) {
    for (const std::string_view key : {"driver", "pings"}) {
        const Value* const value = section.get(key);
        if (value == nullptr) continue;
        if (scenario.clock != ClockMode::free) {
            problems.add(value->key_place,
                         section.path_of(key) +
                             ": only a free run brings drivers of its own; add clock: {mode: "
                             "free}, or remove it");
        } else if (key == "pings") {
            read_pings(section, device, problems);
        } else if (value->is_scalar()) {
            read_file(section, scenario, device, problems);
        } else {
            LineReader(device, problems).read(*value, section.path_of(key), device.script);
        }
    }
}

}  // namespace echoloop::scenario
