#include "emulator/devices/nmea-ins/settings.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "emulator/contract/endpoint.h"

namespace echoloop::nmea_ins {
namespace {

const char* const own = "own choice";

void check_talker(const std::string& talker) {
    const bool good = talker.size() == 2 && std::ranges::all_of(talker, [](char c) {
                          return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
                      });
    if (!good)
        throw std::invalid_argument("option 'talker': '" + talker +
                                    "' is no talker identifier; write two capital letters like IN");
}

Word word_called(const std::string& name) {
    const auto* row = std::ranges::find(words, name, &WordRow::name);
    if (row == words.end())
        throw std::invalid_argument("option 'ports': '" + name +
                                    "' is not known; write some of GGA ZDA VTG HDT PASHR TSS1 EM3000");
    return static_cast<Word>(row - words.begin());
}

/// "GGA ZDA; TSS1": one list for each endpoint, the last one for those beyond.
std::vector<std::vector<Word>> read_ports(const std::string& text, std::size_t endpoints) {
    std::vector<std::vector<Word>> all;
    std::istringstream groups(text);
    for (std::string group; std::getline(groups, group, ';');) {
        std::istringstream names(group);
        all.emplace_back();
        for (std::string name; names >> name;) all.back().push_back(word_called(name));
        if (all.back().empty())
            throw std::invalid_argument("option 'ports': endpoint " + std::to_string(all.size()) +
                                        " is told nothing; write e.g. GGA ZDA HDT; TSS1");
    }
    if (all.empty()) throw std::invalid_argument("option 'ports' is empty; write e.g. GGA ZDA HDT; TSS1");
    if (all.size() > endpoints)
        throw std::invalid_argument("option 'ports' has " + std::to_string(all.size()) + " lists for " +
                                    std::to_string(endpoints) + " endpoints; add endpoints or remove lists");
    while (all.size() < endpoints) all.push_back(all.back());
    return all;
}

/// A line that cannot carry its words would make them older and older.
void check_lines(const Settings& s, const std::vector<Endpoint>& endpoints) {
    constexpr double bits_per_byte = 10;
    for (std::size_t i = 0; i < s.ports.size(); ++i) {
        if (s.baud == 0 || endpoints[i].on_udp()) continue;
        double needed = 0;
        for (const Word word : s.ports[i]) {
            const auto n = static_cast<std::size_t>(word);
            needed += bits_per_byte * words[n].bytes * s.rates[n];
        }
        if (needed > s.baud)
            throw std::invalid_argument("endpoint " + std::to_string(i + 1) + " is to carry " +
                                        std::to_string(static_cast<long>(needed)) + " bit/s on a line of " +
                                        std::to_string(static_cast<long>(s.baud)) +
                                        "; lower rates, raise 'baud', or share the words out in 'ports'");
    }
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    o.text(s.talker, "talker", "talker identifier of the sentences but PASHR",
           "NMEA 0183: IN is integrated navigation; units on survey vessels use it");
    std::string ports = "GGA ZDA VTG HDT PASHR; TSS1; EM3000";
    o.text(ports, "ports",
           "what each endpoint is told, lists parted by ';'; the last one counts for endpoints beyond it",
           "own choice: text and binary formats have lines of their own on vessels");
    for (std::size_t i = 0; i < words.size(); ++i)
        o.number(s.rates[i], words[i].option, "Hz", 0, 200,
                 "how often " + std::string(words[i].name) + " is said, at whole parts of UTC; 0: never",
                 "own choice: usual for the format");
    o.number(s.baud, "baud", "bit/s", 0, 4e6, "line rate of pty and TCP endpoints, not of UDP; 0: not paced",
             own);
    o.number(s.latency, "latency", "s", 0, 1, "from a moment to the first byte about it", own);
    o.number(s.time_error, "time_error", "s", -20, 20,
             "added to all time stamps, as by a clock that is wrong or lacks leap seconds", own);
    o.number(s.latitude, "latitude", "deg", -89, 89,
             "of the scene's origin; where both are 0, as the scene says", own);
    o.number(s.longitude, "longitude", "deg", -180, 180, "of the scene's origin", own);
    f.number(s.strays.position.drift, "position_drift", "m", 0, 100, "of each axis, within minutes");
    f.number(s.strays.position.noise, "position_noise", "m", 0, 100, "of each axis and of heave, each time");
    f.number(s.strays.motion.drift, "motion_drift", "deg", 0, 10, "of roll and pitch, within minutes");
    f.number(s.strays.motion.noise, "motion_noise", "deg", 0, 10, "of roll and pitch, each time");
    f.number(s.strays.heading.drift, "heading_drift", "deg", 0, 10, "within minutes");
    f.number(s.strays.heading.noise, "heading_noise", "deg", 0, 10, "each time");
    f.number(s.strays.velocity.drift, "velocity_drift", "m/s", 0, 10, "of each axis, within minutes");
    f.number(s.strays.velocity.noise, "velocity_noise", "m/s", 0, 10, "of each axis, each time");
}

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    s.baud = line_rate(config.endpoints, s.baud);
    s.ports = read_ports(std::get<std::string>(config.options.at("ports")), config.endpoints.size());
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto has_it = [i](const auto& told) {
            return std::ranges::count(told, static_cast<Word>(i)) > 0;
        };
        if (std::ranges::none_of(s.ports, has_it)) s.rates[i] = 0;
    }
    s.unix_start = config.unix_start;
    if (config.origin) {
        s.height = config.origin->height;
        if (s.latitude == 0 && s.longitude == 0)
            s.latitude = config.origin->latitude, s.longitude = config.origin->longitude;
    }
    check_talker(s.talker);
    check_lines(s, config.endpoints);
    return s;
}

}  // namespace echoloop::nmea_ins
