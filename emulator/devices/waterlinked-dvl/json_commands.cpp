#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "emulator/devices/family/waterlinked/clock_text.h"
#include "emulator/devices/waterlinked-dvl/commands.h"
#include "emulator/devices/waterlinked-dvl/report.h"

namespace echoloop::waterlinked_dvl {
namespace {

using Json = nlohmann::ordered_json;

/// What a command makes: a result as JSON, or why it failed.
struct Outcome {
    std::string result = "null";
    std::string error{};
    double after = 0;  ///< s
};
Outcome failed(std::string error) { return {.error = std::move(error)}; }
Outcome wrong(std::string_view parameter) { return failed("Invalid parameter: " + std::string(parameter)); }

std::string flag_text(bool value) { return value ? "true" : "false"; }

/// Sets `member` from a parameter of that name, if there is one; false if it is of another type.
bool take(const Json& parameters, const char* name, bool& member) {
    const auto found = parameters.find(name);
    if (found == parameters.end()) return true;
    if (found->is_boolean()) member = found->get<bool>();
    return found->is_boolean();
}
bool take(const Json& parameters, const char* name, double& member, bool (*fits)(double)) {
    const auto found = parameters.find(name);
    if (found == parameters.end()) return true;
    if (!found->is_number() || !fits(found->get<double>())) return false;
    member = found->get<double>();
    return true;
}
bool take(const Json& parameters, const char* name, RangeMode& member) {
    const auto found = parameters.find(name);
    if (found == parameters.end()) return true;
    const auto mode = found->is_string() ? read_range_mode(found->get<std::string>()) : std::nullopt;
    if (mode) member = *mode;
    return mode.has_value();
}

Outcome reset(const Json&, State& s, const Settings&) {
    s.reset = true;
    return {};
}

Outcome calibrate(const Json&, State& s, const Settings&) {
    constexpr double duration = 5;  // s; own choice, up to 15 by the documentation
    s.calibrate = true;
    return {.after = duration};
}

Outcome trigger(const Json&, State& s, const Settings&) {
    if (s.configuration.acoustic_enabled) return failed("Acoustics must be disabled to trigger pings");
    if (s.triggers >= most_triggers) return failed("Too many pings queued");
    ++s.triggers;
    return {};
}

Outcome get_config(const Json&, State& s, const Settings&) {
    return {.result = configuration_text(s.configuration)};
}

/// All that it is told, or nothing. Keys that it does not know are passed over.
Outcome set_config(const Json& parameters, State& s, const Settings&) {
    Configuration c = s.configuration;
    if (!parameters.is_object()) return wrong("parameters");
    if (!take(parameters, "speed_of_sound", c.speed_of_sound, is_speed_of_sound))
        return wrong("speed_of_sound");
    if (!take(parameters, "mounting_rotation_offset", c.mounting_rotation_offset, is_rotation))
        return wrong("mounting_rotation_offset");
    if (!take(parameters, "acoustic_enabled", c.acoustic_enabled)) return wrong("acoustic_enabled");
    if (!take(parameters, "dark_mode_enabled", c.dark_mode_enabled)) return wrong("dark_mode_enabled");
    if (!take(parameters, "range_mode", c.range_mode)) return wrong("range_mode");
    if (!take(parameters, "periodic_cycling_enabled", c.periodic_cycling_enabled))
        return wrong("periodic_cycling_enabled");
    s.configuration = c;
    return {};
}

Outcome version(const Json&, State&, const Settings& settings) { return {.result = about_text(settings)}; }

Outcome set_ntp(const Json& parameters, State& s, const Settings&) {
    const auto found = parameters.is_object() ? parameters.find("ntp_address") : parameters.end();
    if (found == parameters.end() || !found->is_string() || !waterlinked_family::is_host(*found))
        return wrong("ntp_address");
    s.ntp_address = found->get<std::string>();
    return {};
}
Outcome get_ntp(const Json&, State& s, const Settings&) {
    return {.result = Json{{"ntp_address", s.ntp_address}}.dump()};
}

Json time_status(const State& s, const Settings& settings) {
    constexpr double between_syncs = 64;  // s, of NTP's shortest polls
    Json json{{"system_time", waterlinked_family::rfc3339(s.unix_now + s.clock_error)},
              {"ntp_synced", settings.ntp_reached},
              {"ntp_synced_to", ""},
              {"ntp_seconds_since_last_sync", nullptr}};
    if (!settings.ntp_reached) return json;
    json["ntp_synced_to"] = s.ntp_address == "auto" ? "pool.ntp.org" : s.ntp_address;
    json["ntp_seconds_since_last_sync"] = static_cast<int>(std::fmod(s.unix_now, between_syncs));
    return json;
}
Outcome get_time(const Json&, State& s, const Settings& settings) {
    return {.result = time_status(s, settings).dump()};
}

Outcome set_time(const Json& parameters, State& s, const Settings& settings) {
    const auto found = parameters.is_object() ? parameters.find("now") : parameters.end();
    const bool text = found != parameters.end() && found->is_string();
    const auto time = text ? waterlinked_family::read_rfc3339(*found) : std::nullopt;
    if (!time) return wrong("now");
    if (settings.ntp_reached) return failed("Manual time not allowed when NTP is synchronized");
    s.clock_error = *time - s.unix_now;
    return {};
}

Outcome force_sync(const Json& parameters, State& s, const Settings& settings) {
    constexpr double longest = 60;  // s
    const auto found = parameters.is_object() ? parameters.find("timeout_seconds") : parameters.end();
    if (found == parameters.end() || !found->is_number()) return wrong("timeout_seconds");
    const double timeout = found->get<double>();
    if (!(timeout >= 0) || timeout > longest) return wrong("timeout_seconds");
    const bool good = settings.ntp_reached;
    const Json result{{"success", good},
                      {"message", good ? "Synchronized" : "No NTP sync within the timeout"},
                      {"status", time_status(s, settings)}};
    return {.result = result.dump(), .after = good ? 0 : timeout};
}

struct Command {
    std::string_view name;
    Level since;
    Outcome (*run)(const Json& parameters, State& state, const Settings& settings);
};
constexpr std::array commands{
    Command{"reset_dead_reckoning", Level::v2_2, reset},  Command{"calibrate_gyro", Level::v2_2, calibrate},
    Command{"trigger_ping", Level::v2_4, trigger},        Command{"get_config", Level::v2_2, get_config},
    Command{"set_config", Level::v2_2, set_config},       Command{"get_version_info", Level::v2_7_2, version},
    Command{"set_time_ntp", Level::v2_7_2, set_ntp},      Command{"get_time_ntp", Level::v2_7_2, get_ntp},
    Command{"set_time_manual", Level::v2_7_2, set_time},  Command{"get_time_status", Level::v2_7_2, get_time},
    Command{"force_sync_ntp", Level::v2_7_2, force_sync},
};

Answer written(const std::string& command, const Outcome& outcome, const Settings& settings) {
    const bool good = outcome.error.empty();
    const auto quoted = [](std::string_view text) {
        return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    const std::string text = R"({"response_to":)" + quoted(command) + R"(,"success":)" + flag_text(good) +
                             R"(,"error_message":)" + quoted(outcome.error) + R"(,"result":)" +
                             (good ? outcome.result : "null") + R"(,"format":)" + quoted(settings.format()) +
                             R"(,"type":"response"})";
    return {ended(text, settings), good, outcome.after};
}

}  // namespace

bool is_speed_of_sound(double value) { return value >= 1000 && value <= 2000; }
bool is_rotation(double value) { return value >= 0 && value <= 360; }

std::string configuration_text(const Configuration& c) {
    char numbers[128];
    std::snprintf(numbers, sizeof numbers, R"({"speed_of_sound":%.2f,"acoustic_enabled":%s)",
                  c.speed_of_sound, flag_text(c.acoustic_enabled).c_str());
    char rotation[64];
    std::snprintf(rotation, sizeof rotation, R"(,"mounting_rotation_offset":%.2f)",
                  c.mounting_rotation_offset);
    return std::string(numbers) + R"(,"dark_mode_enabled":)" + flag_text(c.dark_mode_enabled) + rotation +
           R"(,"range_mode":")" + c.range_mode.text + R"(","periodic_cycling_enabled":)" +
           flag_text(c.periodic_cycling_enabled) + '}';
}

std::string chip_text(const Settings& settings) {
    char text[32];
    std::snprintf(text, sizeof text, "0x%014llx",
                  static_cast<unsigned long long>(settings.chip_id & 0xFFFFFFFFFFFFFFULL));
    return text;
}

std::string about_text(const Settings& settings) {
    const std::string version(settings.version());
    return Json{{"chipid", chip_text(settings)},
                {"hardware_revision", 4},
                {"product_id", settings.product == "DVL A50" ? 21035 : 21040},
                {"product_name", settings.product},
                {"variant", settings.performance ? "performance" : "standard"},
                {"version_short", version},
                {"version", version + " (v" + version + "-0-g5b1e2c7)"},  // as git describes a build
                {"is_ready", true}}
        .dump();
}

Answer answer(std::string_view document, State& state, const Settings& settings) {
    const Json json = Json::parse(document, nullptr, false);
    if (json.is_discarded() || !json.is_object()) return written("", failed("Invalid JSON"), settings);
    const auto name = json.find("command");
    if (name == json.end() || !name->is_string())
        return written("", failed("Command not recognised"), settings);
    const auto command = name->get<std::string>();
    for (const Command& known : commands)
        if (known.name == command && known.since <= settings.level)
            return written(command, known.run(json.value("parameters", Json()), state, settings), settings);
    return written(command, failed("Command not recognised"), settings);
}

}  // namespace echoloop::waterlinked_dvl
