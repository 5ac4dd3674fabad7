#include "tools/view/picture.h"

#include "tools/bag/levels.h"
#include "tools/view/message.h"

namespace echoloop::view {
namespace {

Json pose_json(const Pose& pose) {
    const auto& [p, q] = pose;
    return {p.x, p.y, p.z, q.w, q.x, q.y, q.z};
}

}  // namespace

Kept kept(const SeenPing& ping) { return bag::kept(ping); }

std::string message_of(const Kept& ping) {
    const Echogram& echo = ping.echogram;
    const Shot& shot = echo.shot;
    const bag::Levels levels = bag::levels_of(echo);
    Json head{{"type", "ping"},
              {"device", ping.device},
              {"number", ping.number},
              {"t", to_seconds(ping.transmitted)},
              {"late", to_seconds(ping.late)},
              {"drawn", to_seconds(ping.drawn)},
              {"due", to_seconds(ping.due)},
              {"unit", echo.rule == EchoRule::radiometric ? "dB re 1 uPa" : "dB re full scale"},
              {"floor", levels.floor},
              {"step", levels.step},
              {"noise", levels.noise ? Json(*levels.noise) : Json(nullptr)},
              {"rows", levels.rows},
              {"beams", levels.beams},
              {"bins", levels.bins},
              {"bearings", levels.bearings},
              {"elevations", rounded(shot.elevations)},
              {"beam_width", shot.beam_width},
              {"fan_height", shot.fan_height},
              {"pan", shot.pan},
              {"tilt", shot.tilt},
              {"sides", levels.sides},
              {"first_range", levels.first_range},
              {"bin_size", levels.bin_size},
              {"frequency", shot.frequency},
              {"pulse_length", shot.pulse_length},
              {"source_level", shot.source_level},
              {"sonar", pose_json(echo.world_from_sonar)},
              {"objects", !levels.objects.empty()}};
    head["movers"] = Json::array();
    for (const Pose& mover : ping.movers) head["movers"].push_back(pose_json(mover));
    return with_head(head, levels.bytes + levels.objects);
}

}  // namespace echoloop::view
