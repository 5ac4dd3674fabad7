#include "tools/view/picture.h"

#include <algorithm>
#include <cmath>

#include "tools/view/reduce.h"

namespace echoloop::view {
namespace {

constexpr float step = 0.5F;  // dB

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
    const bool objects = echo.objects.size() == echo.values.size();
    to.for_each([&echo](std::size_t at) { return echo.values[at]; },
                [&](std::size_t loudest) {
                    const float most = echo.values[loudest];
                    planes.levels += to_byte(most > 0 ? level_db(most) : floor - step, floor, step);
                    if (objects) put_le(planes.objects, echo.objects[loudest], 2);
                });
    return planes;
}

}  // namespace

Kept kept(const SeenPing& ping) {
    return {std::string(ping.device),
            ping.number,
            ping.transmitted,
            ping.late,
            ping.drawn,
            ping.due,
            ping.echogram,
            ping.movers};
}

std::string message_of(const Kept& ping) {
    const Echogram& echo = ping.echogram;
    const Shot& shot = echo.shot;
    const Grouping to(shot.rows(), shot.bearings.size(), shot.bins);
    float loudest = 0;
    for (const float value : echo.values) loudest = std::max(loudest, value);
    const float top = loudest > 0 ? std::ceil(level_db(loudest)) : 0;
    const float floor = top - step * static_cast<float>(byte_steps);
    const Planes planes = planes_of(echo, to, floor);
    const double metres = echo.sound_speed / 2;
    Json head{{"type", "ping"},
              {"device", ping.device},
              {"number", ping.number},
              {"t", to_seconds(ping.transmitted)},
              {"late", to_seconds(ping.late)},
              {"drawn", to_seconds(ping.drawn)},
              {"due", to_seconds(ping.due)},
              {"unit", echo.rule == EchoRule::radiometric ? "dB re 1 uPa" : "dB re full scale"},
              {"floor", floor},
              {"step", step},
              {"noise", echo.noise_power > 0 ? Json(10 * std::log10(echo.noise_power)) : Json(nullptr)},
              {"rows", to.rows},
              {"beams", to.beams},
              {"bins", to.bins},
              {"bearings", rounded(shot.bearings, to.per_beam)},
              {"elevations", rounded(shot.elevations, 1)},
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
    return with_head(head, planes.levels + planes.objects);
}

}  // namespace echoloop::view
