#include "tools/bag/sonar_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace echoloop::bag {
namespace {

constexpr double w = SonarPicture::width, h = SonarPicture::height, turn = 2 * std::numbers::pi;
constexpr std::size_t slots = 720;  // directions of a full circle
constexpr std::size_t scope = 70;   // dots of an echogram's last line
constexpr double none = -std::numeric_limits<double>::infinity();

using Colours = std::array<std::array<char, 3>, 256>;

/// From black by copper to white.
const Colours& copper() {
    static const Colours all = [] {
        constexpr double stops[6][3]{{0, 0, 0},      {60, 25, 5},     {150, 75, 15},
                                     {230, 150, 50}, {255, 225, 150}, {255, 255, 245}};
        Colours colours{};
        for (std::size_t i = 0; i < colours.size(); ++i) {
            const double at = static_cast<double>(i) / 255 * 5;
            const std::size_t low = std::min<std::size_t>(static_cast<std::size_t>(at), 4);
            for (std::size_t c = 0; c < 3; ++c) {
                const double value =
                    stops[low][c] + (stops[low + 1][c] - stops[low][c]) * (at - static_cast<double>(low));
                colours[i][c] = static_cast<char>(static_cast<std::uint8_t>(std::nearbyint(value)));
            }
        }
        return colours;
    }();
    return all;
}

void put(std::string& out, std::size_t dot, std::uint8_t colour) {
    std::copy_n(copper()[colour].data(), 3, out.data() + 3 * dot);
}

double level_of(const Levels& levels, std::uint8_t byte) {
    return byte == 0 ? none : levels.floor + (byte - 1) * levels.step;
}

std::size_t slot_of(double bearing) {
    const double share = bearing / turn;
    return static_cast<std::size_t>(
               std::floor((share - std::floor(share)) * static_cast<double>(slots) + 0.5)) %
           slots;
}

/// Four digits: ranges of a message vary with the speed of sound that it tells, by less than a dot.
double rough(double value) {
    if (!(value > 0)) return value;
    const double unit = std::pow(10, std::floor(std::log10(value)) - 3);
    return std::round(value / unit) * unit;
}

/// Of the value next to `at` in an ascending row; -1 where none is within `reach`.
std::int32_t nearest(const std::vector<double>& row, double at, double reach) {
    const auto above = std::upper_bound(row.begin(), row.end() - (row.size() > 1 ? 1 : 0), at);
    const auto high = row.size() > 1 ? std::max(above, row.begin() + 1) : row.begin();
    const auto low = row.size() > 1 ? high - 1 : row.begin();
    const auto best = std::abs(*low - at) <= std::abs(*high - at) ? low : high;
    return std::abs(*best - at) <= reach ? static_cast<std::int32_t>(best - row.begin()) : -1;
}

}  // namespace

void SonarPicture::take(Levels levels) {
    pans_.insert(std::lround(levels.pan * 1000));
    Kind kind = pans_.size() > 1 ? Kind::circle : Kind::echogram;
    if (levels.rows > 1)
        kind = Kind::range_image;
    else if (levels.waterfall || (levels.sides && levels.beams == 2))
        kind = Kind::side_scan;
    else if (levels.sides)
        kind = Kind::echogram;
    else if (levels.beams > 1)
        kind = Kind::fan;
    // The speed of sound that a message tells varies a little, and its ranges with it.
    const double far = levels.farthest();
    const bool alike = last_ && levels.bins == last_->bins && std::abs(far / began_ - 1) < 0.01;
    if (!alike || kind != kind_) {
        lines_.clear();
        directions_.assign(kind == Kind::circle ? slots : 0, std::nullopt);
        top_ = none;
        kind_ = kind;
        began_ = far;
    }
    std::uint8_t loudest = 0;
    for (const char byte : levels.bytes) loudest = std::max(loudest, static_cast<std::uint8_t>(byte));
    constexpr double sinks = 0.2;
    top_ = std::max(top_ - sinks, level_of(levels, loudest));
    if (kind == Kind::circle) directions_[slot_of(levels.pan)] = levels;
    if (kind == Kind::echogram || kind == Kind::side_scan) {
        lines_.push_back(levels);
        if (lines_.size() > width) lines_.erase(lines_.begin());
    }
    last_ = std::move(levels);
}

std::uint8_t SonarPicture::colour(const Levels& of, std::uint8_t byte) const {
    if (byte == 0) return 0;
    const double low = top_ - of.span;
    return static_cast<std::uint8_t>(
        std::clamp(std::floor((level_of(of, byte) - low) / of.span * 255 + 0.5), 0.0, 255.0));
}

std::string SonarPicture::draw() {
    std::string out(width * height * 3, '\0');
    if (!last_ || last_->bins == 0 || last_->bearings.empty()) return out;
    switch (kind_) {
        case Kind::fan:
            sketch_fan(), draw_fan(out);
            break;
        case Kind::circle:
            sketch_circle(), draw_circle(out);
            break;
        case Kind::echogram:
            draw_echogram(out);
            break;
        case Kind::side_scan:
            draw_side_scan(out);
            break;
        case Kind::range_image:
            draw_range_image(out);
            break;
    }
    return out;
}

/// From above, the axis up; beyond half a circle the sonar is in the middle. One that looks down, from
/// behind.
void SonarPicture::sketch_fan() {
    const Levels& ping = *last_;
    const FanKey key{ping.beams,           ping.bins, rough(ping.first_range),
                     rough(ping.bin_size), ping.pan,  ping.bearings.front(),
                     ping.bearings.back(), ping.down};
    if (key == key_) return;
    key_ = key;
    const double first = ping.bearings.front() + ping.pan, last = ping.bearings.back() + ping.pan;
    const double wide = std::max(std::abs(first), std::abs(last)), far = ping.farthest();
    const bool round = wide > std::numbers::pi / 2;
    const double below = round ? -std::cos(std::min(wide, std::numbers::pi)) : 0;
    const double across = round ? 1 : std::max(std::sin(wide), 0.1);
    const double scale = std::min((h - 24) / (far * (1 + below)), (w - 16) / (2 * far * across));
    const double cx = w / 2, cy = h - 12 - far * below * scale;
    const double reach = (last - first) / static_cast<double>(ping.beams - 1);
    fan_.assign(width * height, -1);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            const auto row = static_cast<double>(ping.down ? height - 1 - y : y);
            const double right = (static_cast<double>(x) + 0.5 - cx) / scale,
                         ahead = (cy - row - 0.5) / scale;
            const double bin = std::floor((std::hypot(right, ahead) - ping.first_range) / ping.bin_size);
            if (bin < 0 || bin >= static_cast<double>(ping.bins)) continue;
            const auto beam = nearest(ping.bearings, std::atan2(right, ahead) - ping.pan, reach);
            if (beam >= 0)
                fan_[y * width + x] =
                    beam * static_cast<std::int32_t>(ping.bins) + static_cast<std::int32_t>(bin);
        }
}

void SonarPicture::draw_fan(std::string& out) const {
    for (std::size_t dot = 0; dot < fan_.size(); ++dot)
        if (fan_[dot] >= 0)
            put(out, dot,
                colour(*last_, static_cast<std::uint8_t>(last_->bytes[static_cast<std::size_t>(fan_[dot])])));
}

void SonarPicture::sketch_circle() {
    if (!circle_.empty()) return;
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            const double right = static_cast<double>(x) + 0.5 - w / 2,
                         ahead = h / 2 - static_cast<double>(y) - 0.5;
            circle_.emplace_back(static_cast<std::uint16_t>(slot_of(std::atan2(right, ahead))),
                                 static_cast<float>(std::hypot(right, ahead) / (h / 2 - 8)));
        }
}

/// The line of a direction, or the nearest within 2.5 deg: a head's steps may be as wide.
const Levels* SonarPicture::line_at(std::size_t direction) const {
    for (std::size_t away = 0; away <= 5; ++away)
        for (const std::size_t at : {direction + slots - away, direction + away})
            if (const auto& line = directions_[at % slots]) return &*line;
    return nullptr;
}

void SonarPicture::draw_circle(std::string& out) const {
    std::vector<const Levels*> lines;
    for (std::size_t i = 0; i < slots; ++i) lines.push_back(line_at(i));
    for (std::size_t dot = 0; dot < circle_.size(); ++dot) {
        const auto& [direction, share] = circle_[dot];
        const Levels* line = lines[direction];
        const double bin = std::floor((share * last_->farthest() - last_->first_range) / last_->bin_size);
        if (line != nullptr && bin >= 0 && bin < static_cast<double>(line->bins))
            put(out, dot, colour(*line, line->at(0, static_cast<std::size_t>(bin))));
    }
}

void SonarPicture::draw_echogram(std::string& out) const {
    constexpr std::size_t shown = width - scope;
    for (std::size_t y = 0; y < height; ++y) {
        const std::size_t bin = y * last_->bins / height;
        for (std::size_t x = 0; x < width; ++x) {
            const Levels* line = &*last_;
            if (x >= shown) {
                const double level = (level_of(*last_, last_->at(0, bin)) - top_ + last_->span) / last_->span;
                if (static_cast<double>(x - shown) > level * scope) continue;
            } else {
                if (lines_.size() + x < shown) continue;
                line = &lines_[lines_.size() + x - shown];
            }
            put(out, y * width + x, colour(*line, line->at(0, bin)));
        }
    }
}

void SonarPicture::draw_side_scan(std::string& out) const {
    for (std::size_t y = 0; y < std::min<std::size_t>(height, lines_.size()); ++y) {
        const Levels& line = lines_[lines_.size() - 1 - y];
        for (std::size_t x = 0; x < width; ++x) {
            const bool right = x >= width / 2, single = line.beams == 1;
            const std::size_t along = single ? x : right ? x - width / 2 : width / 2 - 1 - x;
            const std::size_t bin = std::min(line.bins - 1, along * line.bins / (single ? width : width / 2));
            put(out, y * width + x, colour(line, line.at(right ? line.beams - 1 : 0, bin)));
        }
    }
}

/// The range of each beam's loudest bin, near ones bright, where it stands out of the noise; of one bin its
/// level.
void SonarPicture::draw_range_image(std::string& out) const {
    const Levels& ping = *last_;
    constexpr double stands_out = 13;  // dB
    for (std::size_t y = 0; y < height; ++y) {
        const std::size_t row = std::min(ping.rows - 1, (height - 1 - y) * ping.rows / height);
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t beam = row * ping.beams + std::min(ping.beams - 1, x * ping.beams / width);
            const auto* levels = reinterpret_cast<const std::uint8_t*>(ping.bytes.data()) + beam * ping.bins;
            const auto bin = static_cast<std::size_t>(std::max_element(levels, levels + ping.bins) - levels);
            const double level = level_of(ping, levels[bin]);
            if (ping.bins == 1) {
                put(out, y * width + x, colour(ping, levels[0]));
                continue;
            }
            if (levels[bin] == 0 || (ping.noise && level < *ping.noise + stands_out)) continue;
            const double near = 1 - static_cast<double>(bin) / static_cast<double>(ping.bins);
            put(out, y * width + x, static_cast<std::uint8_t>(std::floor(near * 255 + 0.5)));
        }
    }
}

}  // namespace echoloop::bag
