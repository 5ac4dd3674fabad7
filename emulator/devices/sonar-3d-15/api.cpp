#include "emulator/devices/sonar-3d-15/api.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/family/waterlinked/clock_text.h"

namespace echoloop::sonar_3d_15 {
namespace {

constexpr std::string_view root = "/api/v1/integration";
constexpr std::string_view about_page =
    "/api/v1/about";  // by which the maker's own BlueOS extension finds it
constexpr std::array<int, 3> always{0, 0, 0};
constexpr double slowest = 1000, fastest = 2000;  // m/s, by hand

using Json = nlohmann::ordered_json;
using waterlinked_family::is_host, waterlinked_family::read_rfc3339, waterlinked_family::rfc3339;

/// The member of an object, or the value itself where `name` is empty; nothing if it is not of type T.
template <class T>
std::optional<T> value_of(const Json& json, const char* name = "") {
    if (*name != 0 && !json.contains(name)) return std::nullopt;
    const Json& value = *name != 0 ? json.at(name) : json;
    const bool fits = std::is_same_v<T, bool>     ? value.is_boolean()
                      : std::is_same_v<T, double> ? value.is_number()
                                                  : value.is_string();
    return fits ? std::optional(value.get<T>()) : std::nullopt;
}

/// The shortest digits that read back as the same number, with a decimal point or an exponent: 21.0. Not as
/// the library writes them: 1e-04, not 0.0001.
std::string number_text(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    std::string text(digits.data(), end);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string release_text(const Settings& s) {
    return std::to_string(s.release[0]) + '.' + std::to_string(s.release[1]) + '.' +
           std::to_string(s.release[2]);
}

std::string about(const State&, const Settings& s) {
    const std::string release = release_text(s);
    char chip_id[16];
    std::snprintf(chip_id, sizeof chip_id, "0x%08x", s.chip_id);
    return Json{{"chipid", chip_id},
                {"hardware_revision", 6},
                {"is_ready", true},
                {"product_id", 21045},
                {"product_name", "Sonar 3D-15"},
                {"variant", ""},
                {"version", release + " (v" + release + "-0-g4c1d9e7)"},  // as git describes a build
                {"version_short", release}}
        .dump();
}

Json status_entry(const char* id, const char* message) {
    return {{"id", id}, {"message", message}, {"operational", true}, {"status", "ok"}};
}

std::string status(const State&, const Settings&) {
    return Json{{"api", status_entry("api-normal", "Integration API is operational.")},
                {"temperature", status_entry("temperature-normal", "Temperature is normal.")},
                {"systems_check", status_entry("systems-check-normal", "Systems are operational.")}}
        .dump();
}

std::string temperature(const State& s, const Settings&) { return number_text(s.temperature); }

std::string get_enabled(const State& s, const Settings&) { return Json(s.enabled).dump(); }
bool set_enabled(const Json& json, State& s, const Settings&) {
    const auto value = value_of<bool>(json);
    if (value) s.enabled = *value;
    return value.has_value();
}

std::string get_range(const State& s, const Settings&) {
    return R"({"min":)" + number_text(s.range_min) + R"(,"max":)" + number_text(s.range_max) + '}';
}
bool set_range(const Json& json, State& s, const Settings& settings) {
    const auto min = value_of<double>(json, "min"), max = value_of<double>(json, "max");
    if (!min || !max || *min < 0 || *max > settings.acoustics.longest_range) return false;
    if (*max - *min < settings.acoustics.finest_bin) return false;
    s.range_min = *min;
    s.range_max = *max;
    return true;
}

std::string get_speed(const State& s, const Settings&) { return number_text(s.speed); }
bool set_speed(const Json& json, State& s, const Settings&) {
    const auto value = value_of<double>(json);
    if (!value || (*value != 0 && (*value < slowest || *value > fastest))) return false;
    s.speed = *value;
    return true;
}

/// Whether the body is one of two words; then `second` says which.
bool read_choice(const Json& json, std::string_view no, std::string_view yes, bool& second) {
    const auto word = value_of<std::string>(json);
    if (!word || (*word != no && *word != yes)) return false;
    second = *word == yes;
    return true;
}

std::string get_mode(const State& s, const Settings&) {
    return Json(s.high ? "high-frequency" : "low-frequency").dump();
}
bool set_mode(const Json& json, State& s, const Settings&) {
    return read_choice(json, "low-frequency", "high-frequency", s.high);
}

std::string get_salinity(const State& s, const Settings&) { return Json(s.salt ? "salt" : "fresh").dump(); }
bool set_salinity(const Json& json, State& s, const Settings&) {
    return read_choice(json, "fresh", "salt", s.salt);
}

constexpr std::array<std::string_view, 3> udp_words{"multicast", "unicast", "disabled"};

std::string get_udp(const State& s, const Settings&) {
    return Json{{"mode", udp_words[static_cast<std::size_t>(s.udp)]},
                {"unicast_destination_ip", s.unicast_ip},
                {"unicast_destination_port", s.unicast_port}}
        .dump();
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
bool set_udp(const Json& json, State& s, const Settings&) {
    const auto mode = value_of<std::string>(json, "mode"),
               ip = value_of<std::string>(json, "unicast_destination_ip");
    const auto port = value_of<double>(json, "unicast_destination_port");
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

Json time_status(const State& s, const Settings& settings) {
    constexpr double between_syncs = 64;  // s, of NTP's shortest polls
    Json json{{"system_time", rfc3339(s.unix_now + s.clock_error)},
              {"ntp_synced", settings.ntp_reached},
              {"ntp_synced_to", ""},
              {"ntp_seconds_since_last_sync", nullptr}};
    if (!settings.ntp_reached) return json;
    json["ntp_synced_to"] = s.ntp_address == "auto" ? "pool.ntp.org" : s.ntp_address;
    json["ntp_seconds_since_last_sync"] = static_cast<int>(std::fmod(s.unix_now, between_syncs));
    return json;
}
std::string get_time_status(const State& s, const Settings& settings) {
    return time_status(s, settings).dump();
}

std::string get_ntp(const State& s, const Settings&) { return Json{{"ntp_address", s.ntp_address}}.dump(); }
bool set_ntp(const Json& json, State& s, const Settings&) {
    const auto address = value_of<std::string>(json, "ntp_address");
    if (!address || !is_host(*address)) return false;
    s.ntp_address = *address;
    return true;
}

Answer set_time(const Json& json, State& s, const Settings& settings) {
    const auto text = value_of<std::string>(json, "now");
    const auto time = text ? read_rfc3339(*text) : std::nullopt;
    if (!time) return {400};
    if (settings.ntp_reached) return {409};
    s.clock_error = *time - s.unix_now;
    return {204};
}

/// Without a server it waits in vain for as long as it was told to.
Answer force_sync(const Json& json, const State& s, const Settings& settings) {
    constexpr double longest = 60;  // s
    const auto timeout = value_of<double>(json, "timeout_seconds");
    if (!timeout || !(*timeout >= 0) || *timeout > longest) return {400};
    const bool good = settings.ntp_reached;
    const Json body{{"success", good},
                    {"message", good ? "Synchronized" : "No NTP sync within the timeout"},
                    {"status", time_status(s, settings)}};
    return {200, body.dump(), good ? 0 : *timeout};
}

std::string get_imu(const State& s, const Settings&) { return Json(s.imu).dump(); }
bool set_imu(const Json& json, State& s, const Settings&) {
    const auto value = value_of<bool>(json);
    if (value) s.imu = *value;
    return value.has_value();
}

struct Path {
    std::string_view path;
    std::array<int, 3> since;  ///< release
    std::string (*get)(const State&, const Settings&);
    bool (*set)(const Json&, State&, const Settings&);  ///< false: a bad request; nullptr: read only
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
    Path{"/time/status", with_time, get_time_status, nullptr},
    Path{"/time/ntp", with_time, get_ntp, set_ntp},
    Path{"/output/imu-batch/enabled", with_imu, get_imu, set_imu},
};

/// Those that only do something.
struct Deed {
    std::string_view path;
    std::array<int, 3> since;  ///< release
    Answer (*does)(const Json&, State&, const Settings&);
};

constexpr std::array deeds{
    Deed{"/time/manual", with_time, set_time},
    Deed{"/time/ntp/force-sync", with_time,
         [](const Json& json, State& s, const Settings& settings) { return force_sync(json, s, settings); }},
};

/// What a host has to say is a bare value or an object of them.
bool is_flat(const Json& json) {
    return !json.is_discarded() &&
           std::none_of(json.begin(), json.end(), [](const Json& value) { return value.is_structured(); });
}

}  // namespace

Answer answer(const http::Request& request, State& state, const Settings& settings) {
    const std::string_view target = std::string_view(request.target).substr(0, request.target.find('?'));
    if (!target.starts_with(root) && target != about_page) return {404};
    const std::string_view asked = target == about_page ? "/about" : target.substr(root.size());
    const auto* deed = std::find_if(deeds.begin(), deeds.end(), [&](const Deed& d) {
        return d.path == asked && d.since <= settings.release;
    });
    if (deed != deeds.end()) {
        if (request.method != "POST") return {405};
        const auto json = Json::parse(request.body, nullptr, false);
        return is_flat(json) ? deed->does(json, state, settings) : Answer{400};
    }
    const auto* path = std::find_if(paths.begin(), paths.end(), [&](const Path& p) {
        return p.path == asked && p.since <= settings.release;
    });
    if (path == paths.end()) return {404};
    if (request.method == "GET") return {200, path->get(state, settings)};
    if (request.method != "POST" || !path->set) return {405};
    const auto json = Json::parse(request.body, nullptr, false);
    return {is_flat(json) && path->set(json, state, settings) ? 204 : 400};
}

}  // namespace echoloop::sonar_3d_15
