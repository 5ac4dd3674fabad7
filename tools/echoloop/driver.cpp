#include "tools/echoloop/driver.h"

#include <algorithm>
#include <map>
#include <regex>

#include "emulator/contract/endpoint.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/driver_port.h"

namespace echoloop::cli {
namespace {

using Words = std::vector<std::pair<std::string, std::string>>;  ///< "{port}" and what stands for it

/// Where a device sends to that listens on no port of its own for it.
std::string told_host(const ScenarioDevice& device, const std::string& port) {
    for (const Destination& sent : device.model->sends)
        if (sent.what == port && !sent.words.empty()) return sent.words;
    for (const Endpoint& end : device.config.endpoints)
        if (end.scheme == Endpoint::Scheme::udp) return address_text(end.host, end.port);
    return "whom it is told to by options or by its host";
}

/// "uart:/tmp/echoloop/ping1d:115200", as SITL names what a serial port of the autopilot is; "": it cannot.
std::string sitl_line(const Endpoint& end, const SerialPort& port) {
    const auto place = address_text(end.host, end.port);
    if (end.scheme == Endpoint::Scheme::tcp_listen) return "tcpclient:" + place;
    if (end.scheme == Endpoint::Scheme::udp_listen) return "udpclient:" + place;
    return port.preparation.empty() ? "uart:" + port.path + ":" + std::to_string(port.rate) : "";
}

Words words_of(const ScenarioDevice& device, const Endpoint& end, const SerialPort& port) {
    Words words{{"{name}", device.name},
                {"{port}", port.path},
                {"{rate}", std::to_string(port.rate)},
                {"{kbaud}", std::to_string(port.rate / 1000)},
                {"{host}", end.host},
                {"{number}", std::to_string(end.port)}};
    const auto serial = device.config.options.find("serial");
    if (serial != device.config.options.end() && std::holds_alternative<std::int64_t>(serial->second))
        words.emplace_back("{serial}", std::to_string(std::get<std::int64_t>(serial->second)));
    if (const auto line = sitl_line(end, port); !line.empty()) words.emplace_back("{sitl}", line);
    for (std::size_t i = 1; i < device.config.endpoints.size(); ++i) {
        const std::string which = " " + std::to_string(i + 1) + "}";
        words.emplace_back("{host" + which, device.config.endpoints[i].host);
        words.emplace_back("{number" + which, std::to_string(device.config.endpoints[i].port));
    }
    for (const auto& [what, endpoint, offset, _] : device.model->sends)
        if (endpoint < device.config.endpoints.size())
            words.emplace_back("{" + what + "}",
                               std::to_string(device.config.endpoints[endpoint].port + offset));
    return words;
}

std::string filled(std::string_view line, const Words& words) {
    std::string result;
    while (!line.empty()) {
        const auto word =
            std::ranges::find_if(words, [&](const auto& w) { return line.starts_with(w.first); });
        result += word == words.end() ? std::string(1, line.front()) : word->second;
        line.remove_prefix(word == words.end() ? 1 : word->first.size());
    }
    return result;
}

bool uses(const KnownDriver& driver, std::string_view word) {
    return std::ranges::any_of(driver.lines,
                               [&](const auto& line) { return line.find(word) != std::string::npos; });
}

/// Whether each word of its lines stands for something here. Braces that hold no word, as in "{", are text.
bool complete(const KnownDriver& driver, const Words& words) {
    static const std::regex word("\\{[a-z0-9 ]+\\}");
    const auto known = [&](const std::string& found) {
        return std::ranges::any_of(words, [&](const auto& w) { return w.first == found; });
    };
    return std::ranges::all_of(driver.lines, [&](const std::string& line) {
        for (std::sregex_iterator at(line.begin(), line.end(), word), end; at != end; ++at)
            if (!known(at->str())) return false;
        return true;
    });
}

DriverHint hint_of(const KnownDriver& driver, const Endpoint& end, const SerialPort& port,
                   const Words& words) {
    DriverHint hint{driver.name, {}, driver.note};
    const bool opens_port = uses(driver, "{port}");
    if (opens_port && !port.preparation.empty()) hint.paste.push_back(port.preparation);
    for (const auto& line : driver.lines) hint.paste.push_back(filled(line, words));
    if (end.scheme == Endpoint::Scheme::serial && (opens_port || uses(driver, "{sitl}")))
        hint.note = "write the port at the driver's end of the cable in place of " + port.path;
    return hint;
}

std::string title_of(const std::string& format) {
    static const std::map<std::string, std::string> titles{
        {"ros1", "ROS 1"}, {"ros2", "ROS 2"},     {"moos", "MOOS"},     {"rock", "Rock"},
        {"dune", "DUNE"},  {"sitl", "ArduPilot"}, {"python", "Python"}, {"maker", "the maker"}};
    return titles.at(format);
}

/// The ports of the device if what is left to the program were `number`.
std::vector<Port> ports_with(DeviceConfig config, const Model& model, std::uint16_t number) {
    for (Endpoint& end : config.endpoints)
        if (end.listens() && end.port == 0) end.port = number;
    return model.make(config)->ports();
}

/// All of them; true: a datagram port whose number is left to the program.
std::vector<std::pair<Port, bool>> ports_of(const ScenarioDevice& device) {
    const auto one = ports_with(device.config, *device.model, 10000);
    const auto another = ports_with(device.config, *device.model, 20000);
    std::vector<std::pair<Port, bool>> all;
    for (std::size_t i = 0; i < one.size(); ++i)
        all.emplace_back(one[i], one[i].bind.port != another[i].bind.port);
    return all;
}

/// Whether it only sends what goes to a place that is told further down.
bool is_source(const ScenarioDevice& device, const Port& port) {
    return port.bind.port != 0 && std::ranges::any_of(device.model->sends, [&](const Destination& sent) {
               return sent.what == port.name && sent.words.empty() &&
                      sent.endpoint < device.config.endpoints.size();
           });
}

DriverHint no_driver(const ScenarioDevice& device, const std::string& format) {
    return {"", {}, "no driver of " + title_of(format) + " for " + device.model->name + " is known to us"};
}

}  // namespace

const std::vector<std::string>& driver_formats() {
    static const std::vector<std::string> formats{"ros1", "ros2", "moos",   "rock",
                                                  "dune", "sitl", "python", "maker"};
    return formats;
}

std::string place_line(const WirePlace& place) { return padded(place.what, 32) + place.address; }

std::vector<WirePlace> wire_places(const ScenarioDevice& device) {
    std::vector<WirePlace> places;
    const Endpoint& first = device.config.endpoints.at(0);
    for (const auto& [port, chosen] : ports_of(device)) {
        if (is_source(device, port)) continue;
        if (port.kind == Port::Kind::datagram && places.empty() && first.scheme == Endpoint::Scheme::udp) {
            places.push_back({"sends " + port.name + " to", address_text(first.host, first.port)});
        } else if (port.kind == Port::Kind::datagram && port.bind.port == 0) {
            places.push_back({"sends " + port.name + " to", told_host(device, port.name)});
        } else if (port.kind == Port::Kind::datagram) {
            const std::string place = text_of(port.bind), host = place.substr(0, place.rfind(':'));
            places.push_back({"listens for " + port.name, address_text(host, chosen ? 0 : port.bind.port)});
        } else {
            const Endpoint& end = device.config.endpoints.at(places.size());
            places.push_back({port.name, stream_address(end, chosen_rate(device))});
        }
    }
    for (const auto& [what, endpoint, offset, words] : device.model->sends) {
        if (endpoint >= device.config.endpoints.size() || !words.empty()) continue;
        const Endpoint& host = device.config.endpoints[endpoint];
        places.push_back({"sends " + what + " to", address_text(host.host, host.port + offset)});
    }
    return places;
}

DriverHint driver_hint(const ScenarioDevice& device, const std::string& format) {
    const Endpoint& end = device.config.endpoints.at(0);
    if (end.listens() && end.port == 0)
        return {
            "", {}, "its port is chosen at the start, and the run says which; name one for lines to paste"};
    const auto port = port_for_driver(device, end);
    const auto words = words_of(device, end, port);
    for (const KnownDriver& driver : device.model->drivers) {
        const bool fits = driver.scheme.empty() || driver.scheme == scheme_name(end.scheme);
        if (driver.format == format && fits && complete(driver, words))
            return hint_of(driver, end, port, words);
    }
    return no_driver(device, format);
}

}  // namespace echoloop::cli
