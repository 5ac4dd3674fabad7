#include "emulator/devices/sonar-3d-15/api.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "protocols/http/json.h"

namespace echoloop::sonar_3d_15 {
namespace {

constexpr std::string_view root = "/api/v1/integration";
constexpr std::string_view sign = "/api/v1/about";  // by which the maker's own BlueOS extension finds it
constexpr std::array<int, 3> always{0, 0, 0}, with_modes{1, 7, 0};
constexpr double slowest = 1000, fastest = 2000;  // m/s, by hand

using http::json_number;
using http::json_string;

template <class T>
const T* scalar(const http::Json& json) {
    const auto* value = std::get_if<http::JsonScalar>(&json);
    return value ? std::get_if<T>(value) : nullptr;
}

template <class T>
const T* member(const http::Json& json, std::string_view name) {
    const auto* object = std::get_if<http::JsonObject>(&json);
    if (!object) return nullptr;
    const auto found = object->find(name);
    return found == object->end() ? nullptr : std::get_if<T>(&found->second);
}

std::string flag_text(bool value) { return value ? "true" : "false"; }

std::string release_text(const Settings& s) {
    return std::to_string(s.release[0]) + '.' + std::to_string(s.release[1]) + '.' +
           std::to_string(s.release[2]);
}

std::string about(const State&, const Settings& s) {
    const std::string release = release_text(s);
    return R"({"chipid":"0x12345678","hardware_revision":6,"is_ready":true,"product_id":21045,)"
           R"("product_name":"Sonar 3D-15","variant":"","version":)" +
           json_string(release + " (echoloop)") + R"(,"version_short":)" + json_string(release) + '}';
}

std::string status_entry(std::string_view id, std::string_view message) {
    return R"({"id":)" + json_string(id) + R"(,"message":)" + json_string(message) +
           R"(,"operational":true,"status":"ok"})";
}

std::string status(const State&, const Settings&) {
    return R"({"api":)" + status_entry("api-normal", "Integration API is operational.") +
           R"(,"temperature":)" + status_entry("temperature-normal", "Temperature is normal.") +
           R"(,"systems_check":)" + status_entry("systems-check-normal", "Systems are operational.") + '}';
}

std::string temperature(const State&, const Settings& s) { return json_number(s.temperature); }

std::string get_enabled(const State& s, const Settings&) { return flag_text(s.enabled); }
bool set_enabled(const http::Json& json, State& s, const Settings&) {
    const bool* value = scalar<bool>(json);
    if (value) s.enabled = *value;
    return value;
}

std::string get_range(const State& s, const Settings&) {
    return R"({"min":)" + json_number(s.range_min) + R"(,"max":)" + json_number(s.range_max) + '}';
}
bool set_range(const http::Json& json, State& s, const Settings& settings) {
    const double *min = member<double>(json, "min"), *max = member<double>(json, "max");
    if (!min || !max || *min < 0 || *max > settings.acoustics.longest_range) return false;
    if (*max - *min < settings.acoustics.finest_bin) return false;
    s.range_min = *min;
    s.range_max = *max;
    return true;
}

std::string get_speed(const State& s, const Settings&) { return json_number(s.speed); }
bool set_speed(const http::Json& json, State& s, const Settings&) {
    const double* value = scalar<double>(json);
    if (!value || (*value != 0 && (*value < slowest || *value > fastest))) return false;
    s.speed = *value;
    return true;
}

/// Whether the body is one of two words; then `second` says which.
bool read_choice(const http::Json& json, std::string_view no, std::string_view yes, bool& second) {
    const auto* word = scalar<std::string>(json);
    if (!word || (*word != no && *word != yes)) return false;
    second = *word == yes;
    return true;
}

std::string get_mode(const State& s, const Settings&) {
    return json_string(s.high ? "high-frequency" : "low-frequency");
}
bool set_mode(const http::Json& json, State& s, const Settings&) {
    return read_choice(json, "low-frequency", "high-frequency", s.high);
}

std::string get_salinity(const State& s, const Settings&) { return json_string(s.salt ? "salt" : "fresh"); }
bool set_salinity(const http::Json& json, State& s, const Settings&) {
    return read_choice(json, "fresh", "salt", s.salt);
}

constexpr std::array<std::string_view, 3> udp_words{"multicast", "unicast", "disabled"};

std::string get_udp(const State& s, const Settings&) {
    return R"({"mode":)" + json_string(udp_words[static_cast<std::size_t>(s.udp)]) +
           R"(,"unicast_destination_ip":)" + json_string(s.unicast_ip) + R"(,"unicast_destination_port":)" +
           std::to_string(s.unicast_port) + '}';
}

bool is_address(const std::string& text) {
    if (text.empty() || text.find_first_not_of("0123456789.") != std::string::npos) return false;
    try {
        parse_endpoint("udp://" + text + ":1");
        return true;
    } catch (const std::invalid_argument&) {
        return false;
    }
}

/// Outside unicast mode address and port may be empty and 0, but no nonsense.
bool set_udp(const http::Json& json, State& s, const Settings&) {
    const auto *mode = member<std::string>(json, "mode"),
               *ip = member<std::string>(json, "unicast_destination_ip");
    const double* port = member<double>(json, "unicast_destination_port");
    if (!mode || !ip || !port || *port < 0 || *port > 65535 || *port != std::floor(*port)) return false;
    const auto word = std::find(udp_words.begin(), udp_words.end(), *mode);
    if (word == udp_words.end()) return false;
    const auto udp = static_cast<UdpMode>(word - udp_words.begin());
    const bool empty = udp != UdpMode::unicast;
    if (!is_address(*ip) && !(empty && ip->empty())) return false;
    if (*port == 0 && !empty) return false;
    s.udp = udp;
    s.unicast_ip = *ip;
    s.unicast_port = static_cast<std::uint16_t>(*port);
    return true;
}

struct Path {
    std::string_view path;
    std::array<int, 3> since;  ///< release
    std::string (*get)(const State&, const Settings&);
    bool (*set)(const http::Json&, State&, const Settings&);  ///< false: a bad request; nullptr: read only
};

constexpr std::array paths{
    Path{"/about", always, about, nullptr},
    Path{"/status", with_modes, status, nullptr},
    Path{"/temperature", always, temperature, nullptr},
    Path{"/acoustics/enabled", always, get_enabled, set_enabled},
    Path{"/acoustics/range", always, get_range, set_range},
    Path{"/acoustics/speed_of_sound", always, get_speed, set_speed},
    Path{"/acoustics/mode", with_modes, get_mode, set_mode},
    Path{"/acoustics/salinity", with_modes, get_salinity, set_salinity},
    Path{"/udp", always, get_udp, set_udp},
};

}  // namespace

Answer answer(const http::Request& request, State& state, const Settings& settings) {
    const std::string_view target = std::string_view(request.target).substr(0, request.target.find('?'));
    if (!target.starts_with(root) && target != sign) return {404};
    const std::string_view asked = target == sign ? "/about" : target.substr(root.size());
    const auto* path = std::find_if(paths.begin(), paths.end(), [&](const Path& p) {
        return p.path == asked && p.since <= settings.release;
    });
    if (path == paths.end()) return {404};
    if (request.method == "GET") return {200, path->get(state, settings)};
    if (request.method != "POST" || !path->set) return {405};
    const auto json = http::read_json(request.body);
    return {json && path->set(*json, state, settings) ? 204 : 400};
}

}  // namespace echoloop::sonar_3d_15
