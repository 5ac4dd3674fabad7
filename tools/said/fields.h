// Fields of a message by name, and small sums that all families need. Numbers only.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "tools/said/said.h"

namespace echoloop::said {

class Fields {
  public:
    explicit Fields(const inspect::Message& message) : message_(message) {}

    /// NaN where there is none, or no number.
    double number(std::string_view name) const {
        const auto* field = find(name);
        return field != nullptr && field->number ? *field->number : std::numeric_limits<double>::quiet_NaN();
    }
    /// Empty where there is no such row.
    const std::vector<double>& numbers(std::string_view name) const {
        static const std::vector<double> none;
        const auto* field = find(name);
        return field != nullptr ? field->numbers : none;
    }

  private:
    const inspect::Field* find(std::string_view name) const {
        for (const auto& field : message_.fields)
            if (field.name == name) return &field;
        return nullptr;
    }
    const inspect::Message& message_;
};

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180; }

inline std::vector<float> as_floats(const std::vector<double>& values) {
    return {values.begin(), values.end()};
}

/// A range that is one: positive, finite and within what a sonar can mean.
inline float range_or_none(double metres) {
    constexpr double farthest = 20'000;
    return std::isfinite(metres) && metres > 0 && metres < farthest ? static_cast<float>(metres) : 0;
}

/// Amplitudes of more than 8 bits fill no scale of counts: in dB re 1 count.
inline float decibels(double amplitude) {
    return amplitude > 0 ? static_cast<float>(20 * std::log10(amplitude))
                         : std::numeric_limits<float>::quiet_NaN();
}
inline constexpr const char* decibels_of_counts = "dB re 1 count";

/// A picture that holds what can be drawn: every bin has a size, every beam its levels.
inline std::optional<Picture> checked(Picture picture) {
    constexpr std::size_t most = std::size_t{64} << 20;  // levels
    const std::size_t beams = picture.bearings.size() * picture.elevations.size();
    if (beams == 0 || (picture.bins == 0 && picture.ranges.empty())) return std::nullopt;
    if (picture.bins > most / beams || picture.levels.size() != beams * picture.bins) return std::nullopt;
    if (!picture.ranges.empty() && picture.ranges.size() != beams) return std::nullopt;
    if (picture.bins > 0 && !(picture.bin_size > 0 && picture.bin_size < 1000)) return std::nullopt;
    if (!(std::isfinite(picture.first_range) && std::isfinite(picture.pan))) return std::nullopt;
    for (const double bearing : picture.bearings)
        if (!std::isfinite(bearing)) return std::nullopt;
    return picture;
}

/// Samples that lie somewhere along a beam.
struct Strip {
    double bearing = 0;     ///< rad, finite
    std::size_t first = 0;  ///< of the samples from zero range
    std::vector<float> levels{};
};
/// A picture of strips of `sample` m each, from zero range on and a little beyond the last, so that it keeps
/// its size while the bottom moves. Of at most 4,096 bins, each as loud as the loudest sample in it.
std::optional<Picture> picture_of(std::vector<Strip> strips, Picture picture, double sample);

/// Beams in ascending order of their bearings, with their levels and ranges.
void sort_beams(Picture& picture);

std::unique_ptr<Maker> make_heads();   ///< SeaNet, Ping, Cerulean, Imagenex: a beam in a message
std::unique_ptr<Maker> make_depths();  ///< NMEA, altimeters, Doppler logs: a range in a message
std::unique_ptr<Maker> make_oculus();
std::unique_ptr<Maker> make_aris();
std::unique_ptr<Maker> make_sonar3d();
std::unique_ptr<Maker> make_kmall();
std::unique_ptr<Maker> make_reson7k();
std::unique_ptr<Maker> make_r2sonic();
std::unique_ptr<Maker> make_norbit();
std::unique_ptr<Maker> make_edgetech();

}  // namespace echoloop::said
