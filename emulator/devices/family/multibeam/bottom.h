// Bottom detection as a multibeam does it: one arrival time per beam, by magnitude near the specular
// direction and by the middle of the footprint further out. Pure functions of the echogram; knows no device's
// settings.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/echogram.h"

namespace echoloop::multibeam {

/// Two-way times between which a bottom is looked for, s.
struct TimeGate {
    double min = 0, max = 0;
};

/// A layer in which the bottom is looked for; `min` and `max` m below the head.
struct DepthGate {
    double min = 0, max = 0;
    double slope = 0;  ///< rad, positive: shallower to starboard
};

/// Slant ranges between which the bottom is looked for, m.
struct RangeGate {
    double min = 0, max = 0;
};

/// What a host has set; gates that are absent exclude nothing.
struct Gates {
    std::optional<DepthGate> depth;
    std::optional<RangeGate> range;
};

/// The gate of one beam: its `angle` in rad from straight down, starboard positive; `sound_speed` m/s as the
/// head believes; `window` s, what it listens at all.
TimeGate time_gate(const Gates& gates, double angle, double sound_speed, double window);

enum class Method { none, magnitude, phase };

struct Detection {
    double time = 0;            ///< two-way, s; 0: no bottom
    double begin = 0, end = 0;  ///< two-way, s; between them the echo is within 10 dB of its peak
    float power = 0;            ///< uPa^2 at the peak
    float mean = 0;             ///< uPa^2, over the stretch around it that is as long as the footprint
    float excess = 0;           ///< dB of the footprint's mean above the least that counts as a bottom
    Method method = Method::none;
    bool in_line = false;  ///< with its neighbours, to 2 % of its time

    bool found() const { return method != Method::none; }
};

/// What counts as a bottom, and what a head knows of its pulse.
struct Rule {
    double margin = 10;  ///< dB above the echogram's noise; an echo below is no bottom
    /// m; nearer are the pulse and the water right before the array. Own choice.
    double nearest = 0.5;
    /// Echoes last as long as the pulse: their middle comes half of it after the bottom.
    bool echoes_last = true;
    /// Echoes that measure so many times the pulse or more are located by phase. Their measured length
    /// scatters by speckle, so the share of phase rises smoothly over angle.
    double phase_length = 5.8;
    /// Soundings by phase, side by side, that are averaged for one, where they lie in line; 1: none.
    std::size_t smoothed = 1;

    /// The same with echoes that last or not, as the effect `pulse` has it.
    Rule with(bool lasting) const {
        Rule rule = *this;
        rule.echoes_last = lasting;
        return rule;
    }
};

/// Detections of all beams, with one gate each: the strongest stretch as long as the beam's footprint on a
/// flat bottom, so that speckle does not break it up, of what does not come through side lobes.
std::vector<Detection> detect(const Echogram& echogram, std::span<const TimeGate> gates, const Rule& rule);

/// The outermost beams, over half a `beam_width` (rad), have too few neighbours beyond them whose phase they
/// could share: where their echoes are long, they go on in the line of the beams inside, as far as that meets
/// the echo. `angles`: rad, one a detection.
void continue_to_edges(std::span<Detection> detections, std::span<const double> angles, double beam_width);

/// A detection off the line of three neighbours on either side, which lie on one themselves, goes to that
/// line, as far as it meets the own echo: speckle left it next to nothing near its axis. Not where beams are
/// closer than half a `beam_width` (rad): those share their speckle. `angles`: rad, one a detection.
void move_to_neighbours(std::span<Detection> detections, std::span<const double> angles, double beam_width);

/// A detection by phase goes to the line through itself and its neighbours, `beams` in all and fewer beside
/// the edges and beside detections by magnitude, where they lie in line and as far as the line meets its own
/// echo. `angles`: rad, one a detection.
void smooth_by_phase(std::span<Detection> detections, std::span<const double> angles, std::size_t beams);

/// Marks the detections that lie in line with two of their neighbours. `angles`: rad, one a detection.
void mark_in_line(std::span<Detection> detections, std::span<const double> angles);

/// Depth below the head of the beams within 30 deg of the axis, or of the middle of a sector that has none
/// there: their median, m; 0 if none of them found a bottom. `angles` in rad from straight down, ascending.
double median_depth(std::span<const Detection> detections, std::span<const double> angles,
                    double sound_speed);

/// Slope of the bottom across the swath, rad, positive where it is shallower to starboard: the median of
/// lines through pairs of detections half a swath apart, within 60 deg of the axis; 0 if there are too few.
double median_slope(std::span<const Detection> detections, std::span<const double> angles);

}  // namespace echoloop::multibeam
