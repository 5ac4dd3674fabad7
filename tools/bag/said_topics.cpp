// Topics of what messages say: the pictures and soundings that are read back from the bytes on the wire.
#include <algorithm>
#include <cmath>

#include "tools/bag/topic_types.h"
#include "tools/bag/topics.h"

namespace echoloop::bag {
namespace {

/// Where a message tells ranges and no levels: a dot at each, of numbered beams in one line.
Levels dots_of(const said::Picture& picture) {
    constexpr std::size_t bins = 360;
    Levels levels = levels_of(picture);
    const std::vector<float> ranges = ranges_of(picture);
    const float farthest = *std::ranges::max_element(ranges);
    levels.bins = bins;
    levels.first_range = 0, levels.bin_size = std::max(farthest, 0.1F) * 1.05 / bins;
    if (picture.numbered) levels.beams = 1, levels.bearings = {0};
    levels.bytes.assign(levels.rows * levels.beams * bins, '\0');
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        if (!(ranges[i] > 0)) continue;
        const auto at = static_cast<std::size_t>(ranges[i] / levels.bin_size);
        for (std::size_t bin = at > 0 ? at - 1 : 0; bin <= std::min(at + 1, bins - 1); ++bin)
            levels.bytes[(picture.numbered ? 0 : i) * bins + bin] = static_cast<char>(bin == at ? 255 : 200);
    }
    return levels;
}

/// Levels as an echogram has them, those that are not there as 0.
Echogram echogram_of(const said::Picture& picture, double sound_speed) {
    Echogram echo;
    echo.sound_speed = sound_speed;
    echo.shot.bearings = picture.bearings;
    if (picture.numbered) echo.shot.bearings.assign(picture.bearings.size(), 0);  // nobody knows them
    if (picture.elevations.size() > 1) echo.shot.elevations = picture.elevations;
    echo.shot.pan = picture.pan;
    echo.shot.bins = picture.bins;
    echo.shot.first_bin_time = 2 * picture.first_range / sound_speed;
    echo.shot.bin_interval = 2 * picture.bin_size / sound_speed;
    echo.values = picture.levels;
    for (float& value : echo.values)
        if (!std::isfinite(value)) value = 0;
    return echo;
}

/// Of a run along the axis of the sonar's own frame, wherever it looks. Of a capture, which has no frames,
/// one that looks down has z up and x ahead, as soundings have.
Vec3 said_direction(bool down, const Shot& shot, const Sounding& beam) {
    if (!down) return direction(shot, beam.bearing - shot.pan, beam.elevation);
    return {0, -std::sin(beam.bearing), -std::cos(beam.bearing)};
}

}  // namespace

void Topics::say(const Wire& wire, const said::Picture& told) {
    const std::string name = ros_name(wire.device);
    // A sonar says pictures of several kinds, and each is a topic's alone: /fan/said/WCD0/image.
    const std::string topic = "/" + name + "/said/" + ros_name(told.name);
    const std::uint64_t said = nanoseconds(wire.unix_time);
    const Stamped head{said, name};
    const Echogram echo = echogram_of(told, said::assumed_sound_speed);
    if (!told.levels.empty()) {
        const std::string& frame = name + "_fan";
        if (told.elevations.size() == 1 && !told.waterfall && !told.numbered && told.bearings.size() > 1)
            take_({topic + "/image", projected_type, said}, [&] {
                return projected_image({said, frame}, echo);
            });
        else if (told.elevations.size() == 1)
            take_({topic + "/raw", raw_type, said}, [&] { return raw_image({said, frame}, echo); });
    }
    // A message of soundings, and one of levels, make a picture each.
    draw(topic + "/" + (told.levels.empty() ? "soundings" : "picture"), head, said,
         told.levels.empty() ? dots_of(told) : levels_of(told));
    if (told.ranges.empty() || told.numbered) return;  // nobody knows where a numbered beam looks
    Soundings all = empty_soundings(echo);
    all.beam_width = 0;
    const bool down = told.down && !frequencies_.contains(wire.device);  // it has not pinged: of a capture
    for (std::size_t i = 0; i < std::min(all.beams.size(), told.ranges.size()); ++i) {
        all.beams[i].range = told.ranges[i];
        all.beams[i].direction = said_direction(down, echo.shot, all.beams[i]);
    }
    take_({topic + "/detections", detections_type, said}, [&] {
        return sonar_detections({said, name + "_fan"}, all);
    });
    take_({topic + "/points", points_type, said}, [&] { return point_cloud(head, all); });
}

}  // namespace echoloop::bag
