// The words of the ground truth. Numbers are the shortest that read back as the same, in every locale.
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "emulator/truth/truth.h"

namespace echoloop {
namespace {

/// Builds one object or list after another; null stands for numbers that JSON cannot write.
class Json {
  public:
    explicit Json(std::string& text) : text_(text) {}

    template <typename Number>
    void number(Number value) {
        if constexpr (std::is_floating_point_v<Number>)
            if (!std::isfinite(value)) {
                text_ += "null";
                return;
            }
        char buffer[32];
        text_.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
    }
    void key(const char* name) {
        if (text_.back() != '{') text_ += ',';
        text_.append("\"").append(name).append("\":");
    }
    template <typename Number>
    void number(const char* name, Number value) {
        key(name);
        number(value);
    }
    /// Words from outside, a scenario's or a scene's, may hold anything.
    void words(const std::string& value) {
        text_ += nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    }
    void words(const char* name, const std::string& value) {
        key(name);
        words(value);
    }
    template <typename Range, typename Item>
    void list(const Range& range, const Item& item) {
        text_ += '[';
        bool first = true;
        for (const auto& value : range) {
            if (!std::exchange(first, false)) text_ += ',';
            item(value);
        }
        text_ += ']';
    }
    template <typename Range, typename Item>
    void list(const char* name, const Range& range, const Item& item) {
        key(name);
        list(range, item);
    }
    /// As in a line of poses.
    void pose(const Pose& pose) {
        const Vec3 p = pose.position;
        const Quat q = pose.orientation;
        const auto plain = [this](double value) { number(value); };
        text_ += '{';
        list("position", std::initializer_list<double>{p.x, p.y, p.z}, plain);
        list("orientation", std::initializer_list<double>{q.w, q.x, q.y, q.z}, plain);
        text_ += '}';
    }
    void pose(const char* name, const Pose& value) {
        key(name);
        pose(value);
    }
    void vector(const char* name, Vec3 v) {
        list(name, std::initializer_list<double>{v.x, v.y, v.z}, [this](double value) { number(value); });
    }
    void open() { text_ += '{'; }
    void close() { text_ += '}'; }

  private:
    std::string& text_;
};

/// A stretch of bins that shows one object.
struct Run {
    std::uint16_t object;
    std::size_t first, bins;
};

std::vector<Run> runs_of(std::span<const std::uint16_t> bins) {
    std::vector<Run> runs;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        if (bins[i] == 0) continue;
        if (i > 0 && bins[i - 1] == bins[i])
            ++runs.back().bins;
        else
            runs.push_back({bins[i], i, 1});
    }
    return runs;
}

void append_shot(Json& json, const Shot& shot) {
    json.key("shot");
    json.open();
    json.number("pan", shot.pan);
    json.number("tilt", shot.tilt);
    json.number("beam_width", shot.beam_width);
    json.number("fan_height", shot.fan_height);
    json.number("first_bin_time", shot.first_bin_time);
    json.number("bin_interval", shot.bin_interval);
    json.number("bins", shot.bins);
    json.number("frequency", shot.frequency);
    json.number("pulse_length", shot.pulse_length);
    json.number("bandwidth", shot.bandwidth);
    json.number("source_level", shot.source_level);
    json.close();
}

void append_water(Json& json, const Water& water) {
    json.key("water");
    json.open();
    json.number("temperature", water.temperature);
    json.number("salinity", water.salinity);
    json.number("ph", water.ph);
    json.number("depth", water.depth);
    json.number("sound_speed", sound_speed(water));
    if (!water.profile.empty())
        json.list("profile", water.profile, [&](const SoundSpeedPoint& point) {
            json.list(std::initializer_list<double>{point.depth, point.speed},
                      [&](double value) { json.number(value); });
        });
    json.close();
}

void append_objects(Json& json, const Echogram& echo) {
    if (echo.objects.empty()) return;
    std::vector<std::vector<Run>> beams;
    for (std::size_t beam = 0; beam < echo.beams(); ++beam)
        beams.push_back(runs_of(std::span(echo.objects).subspan(beam * echo.shot.bins, echo.shot.bins)));
    json.list("objects", beams, [&](const std::vector<Run>& runs) {
        json.list(runs, [&](const Run& run) {
            json.list(std::initializer_list<std::size_t>{run.object, run.first, run.bins},
                      [&](std::size_t number) { json.number(number); });
        });
    });
}

}  // namespace

std::string truth_header_line(const TruthHeader& header) {
    std::string text;
    Json json(text);
    const auto words = [&](const std::string& value) { json.words(value); };
    json.open();
    json.number("echoloop_truth", 1);
    json.words("scenario", header.scenario);
    json.words("scene", header.scene);
    json.number("seed", header.seed);
    json.number("unix_start", header.unix_start);
    json.list("devices", header.devices, [&](const TruthHeader::Device& device) {
        json.open();
        json.words("name", device.name);
        json.words("model", device.model);
        json.pose("body_from_sonar", device.body_from_sonar);
        json.close();
    });
    append_water(json, header.water);
    json.list("objects", header.objects, words);
    json.list("movers", header.movers, words);
    json.close();
    return text;
}

void append_truth_line(const PingTruth& ping, std::string& text) {
    const Echogram& echo = ping.echo;
    Json json(text);
    json.open();
    json.words("device", ping.device);
    json.number("ping", echo.shot.ping);
    json.number("t", to_seconds(ping.transmitted));
    json.number("unix", ping.unix_time);
    json.number("due", to_seconds(ping.due));
    json.pose("world_from_body", ping.world_from_body);
    json.pose("world_from_sonar", echo.world_from_sonar);
    json.vector("sonar_velocity", ping.sonar.velocity);
    json.vector("sonar_turning", ping.sonar.turning);
    json.list("movers", ping.movers, [&](const Pose& pose) { json.pose(pose); });
    json.number("sound_speed", echo.sound_speed);
    json.number("noise_power", echo.noise_power);
    append_shot(json, echo.shot);
    json.list("beams", echo.shot.bearings, [&](double bearing) { json.number(static_cast<float>(bearing)); });
    if (echo.shot.rows() > 1)
        json.list("rows", echo.shot.elevations,
                  [&](double elevation) { json.number(static_cast<float>(elevation)); });
    json.list("axis_range", echo.truth, [&](const BeamTruth& truth) { json.number(truth.axis_range); });
    json.list("nearest_range", echo.truth, [&](const BeamTruth& truth) { json.number(truth.nearest_range); });
    append_objects(json, echo);
    if (!ping.visible.empty())
        json.list("visible", ping.visible, [&](const auto& object) {
            json.list(std::initializer_list<double>{static_cast<double>(object.first), object.second},
                      [&](double value) { json.number(value); });
        });
    json.list("faults", ping.faults, [&](const std::string& fault) { json.words(fault); });
    json.close();
}

}  // namespace echoloop
