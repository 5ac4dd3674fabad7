// What a device asks of the water (Shot) and what it hears (Echogram). Standard library only, so that a
// device links no GL. Never normalised by its own content: levels are absolute.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "render/pose.h"

namespace echoloop {

/// How a rendered sample becomes echo strength.
enum class EchoRule {
    radiometric,    ///< received power in uPa^2: spreading, absorption, Lambert scattering (default)
    cerqueira2016,  ///< equation 1 of Cerqueira et al. 2016: mean sigmoid of cos(incidence), 0..1
};

/// What gives a beam its pattern along one axis.
enum class ApertureShape {
    line,     ///< unshaded line or rectangle: sinc, side lobes -13.26 dB one way
    hamming,  ///< line with Hamming shading: side lobes about -42 dB one way
    piston,  ///< circular piston, 2 J1(x)/x: side lobes -17.57 dB one way; one beam of equal width and height
};

struct AxisPattern {
    ApertureShape shape = ApertureShape::line;
    int ways = 2;  ///< 2: the same aperture transmits and receives; 1: only one of the two is directive here
    friend bool operator==(const AxisPattern&, const AxisPattern&) = default;
};

/// What a receiver makes of the looks in a bin that is longer than the pulse.
enum class BinRule {
    mean,    ///< their mean power
    peak,    ///< the strongest: raises the level of a bin of several looks
    sample,  ///< one of them
};

struct RingDown;      // render/acoustics/ring_down.h
struct Interference;  // render/acoustics/interference.h

/// What the receiver adds to and does with the echo, before the device's own gain.
struct Receiver {
    double bandwidth = 0;          ///< Hz, for the noise; 0: that of the pulse
    double directivity_index = 0;  ///< dB, against isotropic noise
    /// dB re 1 uPa^2/Hz, beside the thermal noise and like it before the directivity index; -inf: none
    double self_noise = -std::numeric_limits<double>::infinity();
    double saturation_level =
        std::numeric_limits<double>::infinity();  ///< dB re 1 uPa, where its input clips
    int converter_bits = 0;                       ///< of the amplitude up to saturation_level; 0: no steps
    /// Converters whose outputs a beam is formed from, one for each stave; 1: one converter behind the beam.
    int staves = 1;
    BinRule bins = BinRule::mean;
    std::shared_ptr<const RingDown> ring_down = nullptr;         ///< null: none
    std::shared_ptr<const Interference> interference = nullptr;  ///< null: none
    /// Hz, -3 dB, of a tuned circuit behind which the noise correlates over range; 0: none, an even band
    double noise_circuit = 0;
    double most_looks = std::numeric_limits<double>::infinity();  ///< that a bin takes, however long it is
    friend bool operator==(const Receiver&, const Receiver&) = default;
};

/// How the staves of a real array differ from each other: standard deviations. They raise the floor of side
/// lobes.
struct ArrayErrors {
    double amplitude = 0;    ///< dB
    double phase = 0;        ///< rad
    std::uint64_t unit = 0;  ///< the random numbers' key: the same for every ping of one unit
    friend bool operator==(const ArrayErrors&, const ArrayErrors&) = default;
};

/// One of a shot's single-beam arrays, such as one side of a side-scan sonar.
struct Side {
    double depression = 0;    ///< rad, of its axis below the plane of the fan
    double source_level = 0;  ///< dB re 1 uPa at 1 m
    friend bool operator==(const Side&, const Side&) = default;
};

/// One ping as a device asks for it.
///
/// Sonar frame: x along the acoustic axis, y to port, z up (FLU). A bearing is clockwise positive seen from
/// above (starboard positive), an elevation is positive upwards:
///     direction = (cos e cos b, -cos e sin b, sin e), b = pan + bearing, e relative to the tilted fan plane.
/// `pan` turns the head about z first, `tilt` then raises the fan about the panned y axis (negative looks
/// down). With `elevations` the beams stand in rows above each other, and e of a beam is that of its row: a
/// whole image in one ping. Its rows and columns must not be farther apart than beams are high and wide, or
/// what is between them is missing from side lobes.
struct Shot {
    std::uint64_t ping = 0;        ///< ping number of the device, keys the random numbers
    double pan = 0;                ///< rad, bearing of the fan's centre
    double tilt = 0;               ///< rad, elevation of the fan's centre plane
    std::vector<double> bearings;  ///< rad, beam centres relative to pan, strictly ascending, within +-pi
    /// rad, of rows of beams, each with all bearings; strictly ascending, within +-60 deg, as the bearings
    /// then are. Empty: one row, in the fan's plane.
    std::vector<double> elevations;
    double beam_width = 0;      ///< rad, horizontal width of one beam (two-way, -3 dB)
    double fan_height = 0;      ///< rad, vertical aperture of the fan, or of each beam of rows (-3 dB)
    double first_bin_time = 0;  ///< s, two-way time of the leading edge of bin 0 (t0)
    double bin_interval = 0;    ///< s, two-way time per bin (dt)
    std::size_t bins = 0;       ///< range bins per beam
    double frequency = 0;       ///< Hz, centre frequency
    double pulse_length = 0;    ///< s
    double bandwidth = 0;       ///< Hz of a chirp; 0 for CW
    double source_level = 0;    ///< dB re 1 uPa at 1 m
    AxisPattern horizontal;     ///< of each beam, across beam_width
    AxisPattern vertical;       ///< of the fan, across fan_height
    Receiver receiver;
    ArrayErrors errors;       ///< of the receiving array
    std::vector<Side> sides;  ///< one for each bearing where every beam has an array of its own; else empty
    double interval = 0;      ///< s to the next transmission; 0: so long that nothing is heard of this one
    bool velocities = false;  ///< Echogram::velocities is wanted: of fans and single beams, not of rows
    std::uint64_t random_key = 0;  ///< of seed and device; the session sets it, a device leaves it alone

    std::size_t rows() const { return elevations.empty() ? 1 : elevations.size(); }
    std::size_t beams() const { return bearings.size() * rows(); }

    friend bool operator==(const Shot&, const Shot&) = default;
};

/// What is really there, beside the levels of one beam.
struct BeamTruth {
    float axis_range =
        std::numeric_limits<float>::quiet_NaN();  ///< m, first surface on the beam axis; NaN: none
    float nearest_range =
        std::numeric_limits<float>::quiet_NaN();  ///< m, nearest surface in the beam; NaN: none
};

/// How fast what a beam hears in a bin comes nearer, in m/s: the mean over all that it hears there directly,
/// weighed by power, and its standard deviation. NaN where nothing is heard. Motion of the sonar and of what
/// moves in the scene, without noise: the device adds that of its measurement.
struct ClosingSpeed {
    float mean = std::numeric_limits<float>::quiet_NaN(), spread = std::numeric_limits<float>::quiet_NaN();
};

/// beams x bins of received level, beam-major (all bins of beam 0 first); the beams row by row, the lowest
/// first.
struct Echogram {
    Shot shot;
    Pose world_from_sonar;
    EchoRule rule = EchoRule::radiometric;
    double sound_speed = 0;        ///< m/s, the true one of the water
    std::vector<float> values;     ///< uPa^2 (radiometric) or 0..1 (cerqueira2016); size beams() * shot.bins
    double noise_power = 0;        ///< uPa^2, mean of the noise that is in `values`
    std::vector<BeamTruth> truth;  ///< one per beam
    /// As `values`, for who asks (Situation::objects), else empty: 1 + index in Scene::objects() of what most
    /// of a bin's direct echo comes from; 0: nothing there.
    std::vector<std::uint16_t> objects;
    std::vector<ClosingSpeed> velocities{};  ///< as `values`, for who asks (Shot::velocities), else empty

    std::size_t beams() const { return shot.beams(); }
    std::span<const float> beam(std::size_t index) const {
        return std::span(values).subspan(index * shot.bins, shot.bins);
    }
    /// Slant range in m of the middle of a bin: c t / 2.
    double bin_range(std::size_t bin) const {
        return sound_speed / 2 * (shot.first_bin_time + (static_cast<double>(bin) + 0.5) * shot.bin_interval);
    }
};

/// dB re 1 uPa of a power in uPa^2; -inf for silence.
inline float level_db(float power) { return 10.0F * std::log10(power); }

}  // namespace echoloop
