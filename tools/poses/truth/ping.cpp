#include "tools/poses/truth/ping.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "render/view.h"

namespace echoloop::poses {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_beams = 100'000, most_bins = 100'000;

/// Thrown inside this file only.
struct Refusal {
    std::string reason;
};

const Json& part(const Json& object, const char* key) {
    if (!object.is_object() || !object.contains(key))
        throw Refusal{std::string("\"") + key + "\" is missing"};
    return object[key];
}

double number(const Json& value, const char* what) {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
        throw Refusal{std::string("\"") + what + "\" is no number"};
    return value.get<double>();
}
double number_of(const Json& object, const char* key) { return number(part(object, key), key); }

std::size_t count(const Json& value, const char* what, std::size_t most) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most)
        throw Refusal{std::string("\"") + what + "\" is no count of at most " + std::to_string(most)};
    return value.get<std::size_t>();
}

const Json& list(const Json& object, const char* key, std::size_t most) {
    const Json& value = part(object, key);
    if (!value.is_array() || value.size() > most)
        throw Refusal{std::string("\"") + key + "\" is no list of at most " + std::to_string(most)};
    return value;
}

Pose pose_of(const Json& object, const char* key) {
    const Json& pose = part(object, key);
    const Json &p = list(pose, "position", 3), &q = list(pose, "orientation", 4);
    if (p.size() != 3 || q.size() != 4) throw Refusal{std::string("\"") + key + "\" is no pose"};
    const auto n = [](const Json& value) { return number(value, "position or orientation"); };
    return {{n(p[0]), n(p[1]), n(p[2])}, {n(q[0]), n(q[1]), n(q[2]), n(q[3])}};
}

std::vector<ObjectRun> runs_of(const Json& beam, std::size_t bins) {
    if (!beam.is_array() || beam.size() > bins) throw Refusal{"\"objects\" has no list for a beam"};
    std::vector<ObjectRun> runs;
    for (const Json& run : beam) {
        if (!run.is_array() || run.size() != 3) throw Refusal{"\"objects\": [object, first, bins] is wanted"};
        const std::size_t first = count(run[1], "first bin", bins);
        runs.push_back({static_cast<std::uint32_t>(count(run[0], "object", 0xFFFF)), first,
                        count(run[2], "bins", bins - first)});
    }
    return runs;
}

void add_beams(const Json& json, double pan, double tilt, TruthPing& ping) {
    std::vector<double> rows{0};
    if (json.contains("rows")) {
        rows.clear();
        for (const Json& row : list(json, "rows", most_beams)) rows.push_back(number(row, "rows"));
    }
    const Json& bearings = list(json, "beams", most_beams);
    const Json& ranges = list(json, "axis_range", most_beams);
    const std::size_t all = bearings.size() * rows.size();
    const Json nothing = Json::array();
    const Json& objects = json.contains("objects") ? list(json, "objects", most_beams) : nothing;
    if (bearings.empty() || all > most_beams || ranges.size() != all ||
        (!objects.empty() && objects.size() != all))
        throw Refusal{"\"beams\", \"axis_range\" and \"objects\" differ in length"};
    ping.row_beams = bearings.size();
    for (std::size_t i = 0; i < all; ++i) {
        TruthBeam beam;
        const double bearing = number(bearings[i % bearings.size()], "beams");
        const double elevation = rows[i / bearings.size()];
        beam.bearing = pan + bearing;
        beam.axis = rotate(sonar_from_fan(pan, tilt),
                           {std::cos(elevation) * std::cos(bearing), -std::cos(elevation) * std::sin(bearing),
                            std::sin(elevation)});
        if (!ranges[i].is_null()) beam.range = number(ranges[i], "axis_range");
        if (!objects.empty()) beam.objects = runs_of(objects[i], ping.bins);
        ping.beams.push_back(std::move(beam));
    }
}

TruthPing ping_of(const Json& json) {
    TruthPing ping;
    const Json& device = part(json, "device");
    if (!device.is_string()) throw Refusal{"\"device\" is no text"};
    ping.device = device.get<std::string>();
    ping.unix_time = number_of(json, "unix");
    ping.world_from_sonar = pose_of(json, "world_from_sonar");
    const Json& shot = part(json, "shot");
    const double way = number_of(json, "sound_speed") / 2;  // m of range for a second there and back
    ping.first_range = way * number_of(shot, "first_bin_time");
    ping.bin_size = way * number_of(shot, "bin_interval");
    ping.bins = count(part(shot, "bins"), "bins", most_bins);
    ping.beam_width = number_of(shot, "beam_width");
    if (!(ping.bin_size > 0) || ping.bins == 0) throw Refusal{"its bins have no size"};
    add_beams(json, number_of(shot, "pan"), number_of(shot, "tilt"), ping);
    return ping;
}

}  // namespace

TruthLine read_truth(std::string_view line) {
    const Json json = Json::parse(line, nullptr, false);
    TruthLine out;
    try {
        if (!json.is_object()) throw Refusal{"it is no JSON object"};
        if (json.contains("echoloop_truth")) {
            out.header = true;
            if (json["echoloop_truth"] != 1)
                throw Refusal{"it is another version of the ground truth than 1"};
        } else {
            out.ping = ping_of(json);
        }
    } catch (const Refusal& refusal) {
        out.reason = refusal.reason;
    }
    return out;
}

std::uint32_t object_at(const TruthPing& ping, const TruthBeam& beam, double range) {
    const double bin = std::floor((range - ping.first_range) / ping.bin_size);
    if (!(bin >= 0) || bin >= static_cast<double>(ping.bins)) return 0;
    const auto at = static_cast<std::size_t>(bin);
    for (const ObjectRun& run : beam.objects)
        if (at >= run.first && at < run.first + run.bins) return run.object;
    return 0;
}

}  // namespace echoloop::poses
