#include "tools/poses/truth/picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace echoloop::poses {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr long steps_of_turn = 7200;  // 0.05 deg

long step_of(double bearing) {
    const double part = bearing / turn - std::floor(bearing / turn);
    return std::lround(part * steps_of_turn) % steps_of_turn;
}

/// Steps from one bearing to another, either way.
long apart(long a, long b) {
    const long way = std::abs(a - b);
    return std::min(way, steps_of_turn - way);
}

}  // namespace

std::array<std::uint8_t, 3> object_color(std::uint32_t object) {
    if (object == 0) return {0, 0, 0};
    constexpr double golden = 0.618033988749895;
    const double hue = 6 * (object * golden - std::floor(object * golden));
    const auto channel = [hue](double shift) {
        const double h = std::fmod(hue + shift, 6.0);
        return static_cast<std::uint8_t>(70 + 185 * std::clamp(std::abs(h - 3) - 1, 0.0, 1.0));
    };
    return {channel(0), channel(4), channel(2)};
}

void TruthPicture::add(TruthPing ping) {
    const std::size_t rows = ping.beams.size() / ping.row_beams;
    const auto begin = ping.beams.begin() + static_cast<std::ptrdiff_t>(rows / 2 * ping.row_beams);
    if (ping.row_beams > 1) beams_.clear();
    for (auto beam = begin; beam != begin + static_cast<std::ptrdiff_t>(ping.row_beams); ++beam)
        beams_.insert_or_assign(step_of(beam->bearing),
                                Beam{*beam, ping.beam_width, ping.first_range, ping.bin_size, ping.range()});
}

/// Of the nearest beam, if the bearing is within its width or between it and its neighbour.
std::uint32_t TruthPicture::object_at(double bearing, double range) const {
    constexpr long gap = steps_of_turn / 180;  // beams up to 2 deg apart leave no black between them
    const long step = step_of(bearing);
    auto after = beams_.lower_bound(step);
    const auto before = after == beams_.begin() ? std::prev(beams_.end()) : std::prev(after);
    if (after == beams_.end()) after = beams_.begin();
    const auto& nearest = apart(before->first, step) < apart(after->first, step) ? *before : *after;
    const Beam& beam = nearest.second;
    if (apart(nearest.first, step) > std::max(gap, std::lround(beam.width / 2 / turn * steps_of_turn)))
        return 0;
    const double bin = std::floor((range - beam.first_range) / beam.bin_size);
    for (const ObjectRun& run : beam.beam.objects)
        if (bin >= static_cast<double>(run.first) && bin < static_cast<double>(run.first + run.bins))
            return run.object;
    return 0;
}

RgbPicture TruthPicture::draw(int width) const {
    RgbPicture picture{width, width, {}};
    double range = 0;
    bool ahead = true;  // nothing astern of abeam
    for (const auto& [step, beam] : beams_) {
        range = std::max(range, beam.range);
        ahead = ahead && apart(step, 0) <= steps_of_turn / 4;
    }
    if (ahead) picture.height = (width + 1) / 2;
    picture.bytes.reserve(static_cast<std::size_t>(3) * width * picture.height);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < width; ++x) {
            const double scale = 2 * range / width;
            const double right = (x + 0.5) * scale - range, up = range - (y + 0.5) * scale;
            const double far = std::hypot(right, up);
            const auto color =
                object_color(beams_.empty() || far > range ? 0 : object_at(std::atan2(right, up), far));
            picture.bytes.insert(picture.bytes.end(), color.begin(), color.end());
        }
    return picture;
}

}  // namespace echoloop::poses
