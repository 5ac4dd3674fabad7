#include "tools/view/picture.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace echoloop::view {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_bins = 512, most_beams = 1024;
constexpr float step = 0.5F;  // dB
constexpr int steps = 254;

/// How a picture's beams and bins lie in the echogram's.
struct Grouping {
    std::size_t rows, beams, bins, per_beam, per_bin;  ///< beams: of one row of the picture

    explicit Grouping(const Shot& shot)
        : rows(shot.rows()),
          beams(shot.bearings.size()),
          bins(shot.bins),
          per_beam(1),
          per_bin((shot.bins + most_bins - 1) / most_bins) {
        if (rows == 1) per_beam = (beams + most_beams - 1) / most_beams;
        beams = (beams + per_beam - 1) / per_beam;
        bins = (bins + per_bin - 1) / per_bin;
    }
};

void put_le(std::string& out, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

Json numbers(const std::vector<double>& values, std::size_t every) {
    Json all = Json::array();
    for (std::size_t i = every / 2; i < values.size(); i += every)
        all.push_back(std::round(values[i] * 1e5) / 1e5);
    return all;
}

Json pose_json(const Pose& pose) {
    const auto& [p, q] = pose;
    return {p.x, p.y, p.z, q.w, q.x, q.y, q.z};
}

struct Planes {
    std::string levels, objects;
};

/// Of the loudest sample of each group.
Planes planes_of(const Echogram& echo, const Grouping& to, float floor) {
    Planes planes;
    const std::size_t columns = echo.shot.bearings.size(), bins = echo.shot.bins;
    const bool objects = echo.objects.size() == echo.values.size();
    for (std::size_t row = 0; row < to.rows; ++row)
        for (std::size_t beam = 0; beam < to.beams; ++beam)
            for (std::size_t bin = 0; bin < to.bins; ++bin) {
                std::size_t loudest = 0;
                float most = -1;
                for (std::size_t c = beam * to.per_beam; c < std::min(columns, (beam + 1) * to.per_beam); ++c)
                    for (std::size_t b = bin * to.per_bin; b < std::min(bins, (bin + 1) * to.per_bin); ++b) {
                        const std::size_t at = (row * columns + c) * bins + b;
                        if (echo.values[at] > most) most = echo.values[loudest = at];
                    }
                const float level = most > 0 ? level_db(most) : floor - step;
                planes.levels +=
                    static_cast<char>(std::clamp(static_cast<int>((level - floor) / step + 1), 0, steps + 1));
                if (objects) put_le(planes.objects, echo.objects[loudest], 2);
            }
    return planes;
}

}  // namespace

Kept kept(const SeenPing& ping) { return bag::kept(ping); }

std::string message_of(const Kept& ping) {
    const Echogram& echo = ping.echogram;
    const Shot& shot = echo.shot;
    const Grouping to(shot);
    float loudest = 0;
    for (const float value : echo.values) loudest = std::max(loudest, value);
    const float top = loudest > 0 ? std::ceil(level_db(loudest)) : 0;
    const float floor = top - step * static_cast<float>(steps);
    const Planes planes = planes_of(echo, to, floor);
    const double metres = echo.sound_speed / 2;
    Json head{{"type", "ping"},
              {"device", ping.device},
              {"number", ping.number},
              {"t", to_seconds(ping.transmitted)},
              {"late", to_seconds(ping.late)},
              {"unit", echo.rule == EchoRule::radiometric ? "dB re 1 uPa" : "dB re full scale"},
              {"floor", floor},
              {"step", step},
              {"noise", echo.noise_power > 0 ? Json(10 * std::log10(echo.noise_power)) : Json(nullptr)},
              {"rows", to.rows},
              {"beams", to.beams},
              {"bins", to.bins},
              {"bearings", numbers(shot.bearings, to.per_beam)},
              {"elevations", numbers(shot.elevations, 1)},
              {"beam_width", shot.beam_width},
              {"fan_height", shot.fan_height},
              {"pan", shot.pan},
              {"tilt", shot.tilt},
              {"sides", !shot.sides.empty()},
              {"first_range", metres * shot.first_bin_time},
              {"bin_size", metres * shot.bin_interval * static_cast<double>(to.per_bin)},
              {"frequency", shot.frequency},
              {"pulse_length", shot.pulse_length},
              {"source_level", shot.source_level},
              {"sonar", pose_json(echo.world_from_sonar)},
              {"objects", !planes.objects.empty()}};
    head["movers"] = Json::array();
    for (const Pose& mover : ping.movers) head["movers"].push_back(pose_json(mover));
    const std::string text = head.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string message;
    message.reserve(4 + text.size() + planes.levels.size() + planes.objects.size());
    put_le(message, static_cast<std::uint32_t>(text.size()), 4);
    return message + text + planes.levels + planes.objects;
}

}  // namespace echoloop::view
