#include "tools/draw/polar.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace echoloop::draw {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double same_bearing = 1e-6;  // rad; far below the finest step of any head

/// `angle` plus whole turns, in [from, from + 2 pi).
double wrapped(double angle, double from) { return angle - turn * std::floor((angle - from) / turn); }

void check(const Echogram& ping) {
    const auto require = [](bool good, const char* what) {
        if (!good) throw std::invalid_argument(what);
    };
    const Shot& shot = ping.shot;
    const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
    require(ping.values.size() == ping.beams() * shot.bins,
            "echogram: the number of values is not beams x bins");
    require(positive(ping.sound_speed) && positive(shot.bin_interval) && shot.first_bin_time >= 0 &&
                std::isfinite(shot.first_bin_time),
            "echogram: sound speed, bin interval and first bin time must be positive and finite");
    require(std::isfinite(shot.beam_width) && std::isfinite(shot.pan) &&
                std::all_of(shot.bearings.begin(), shot.bearings.end(),
                            [](double b) { return std::isfinite(b); }),
            "echogram: beam width, pan and bearings must be finite");
}

/// What cannot be a power counts as silence.
double power(float value) { return value > 0 && std::isfinite(value) ? value : 0; }

double between_bins(const Ray& ray, double place) {
    const double inside = std::clamp(place, 0.0, static_cast<double>(ray.values.size()) - 1);
    const auto lower = static_cast<std::size_t>(inside);
    const auto upper = std::min(lower + 1, ray.values.size() - 1);
    const double t = inside - static_cast<double>(lower);
    return (1 - t) * power(ray.values[lower]) + t * power(ray.values[upper]);
}

}  // namespace

PolarScan::PolarScan(std::span<const Echogram> pings) {
    for (std::size_t i = 0; i < pings.size(); ++i) {
        if (pings[i].rule != pings[0].rule) throw std::invalid_argument("pings: the echo rules differ");
        add(pings[i], i);
    }
    if (rays_.empty()) throw std::invalid_argument("pings: there is no beam with a value to draw");
    sort_rays();
    cut_at_widest_gap();
}

void PolarScan::add(const Echogram& ping, std::size_t index) {
    check(ping);
    if (ping.shot.bins == 0) return;
    const double step = ping.bin_range(1) - ping.bin_range(0);
    for (std::size_t i = 0; i < ping.beams(); ++i) {
        const double bearing = wrapped(ping.shot.pan + ping.shot.bearings[i], -std::numbers::pi);
        rays_.push_back(
            {bearing, ping.shot.beam_width, ping.bin_range(0), step, index, ping.beam(i), sums_.size()});
        sum_up(ping.beam(i));
    }
    max_range_ = std::max(max_range_, ping.bin_range(ping.shot.bins - 1) + step / 2);
}

void PolarScan::sum_up(std::span<const float> values) {
    double sum = 0;
    sums_.push_back(sum);
    for (const float value : values) sums_.push_back(sum += power(value));
}

double PolarScan::along(const Ray& ray, double range, double extent) const {
    const double place = (range - ray.first) / ray.step, bins = static_cast<double>(ray.values.size());
    if (!(place >= -0.5 && place <= bins - 0.5)) return 0;
    if (extent <= ray.step) return between_bins(ray, place);
    const auto sum_to = [&](double edge) {  // counted in bins from the leading edge of bin 0
        const double inside = std::clamp(edge, 0.0, bins);
        const auto whole = std::min(static_cast<std::size_t>(inside), ray.values.size() - 1);
        const double* sums = &sums_[ray.first_sum];
        return sums[whole] + (inside - static_cast<double>(whole)) * (sums[whole + 1] - sums[whole]);
    };
    const double half = extent / ray.step / 2, middle = place + 0.5;
    return (sum_to(middle + half) - sum_to(middle - half)) / (2 * half);
}

void PolarScan::sort_rays() {
    std::stable_sort(rays_.begin(), rays_.end(),
                     [](const Ray& a, const Ray& b) { return a.bearing < b.bearing; });
    std::vector<Ray> newest;
    for (const Ray& ray : rays_) {
        if (!newest.empty() && ray.bearing - newest.back().bearing < same_bearing) newest.pop_back();
        newest.push_back(ray);
    }
    rays_ = std::move(newest);
}

void PolarScan::cut_at_widest_gap() {
    std::vector<double> gaps;
    for (std::size_t i = 0; i + 1 < rays_.size(); ++i)
        gaps.push_back(rays_[i + 1].bearing - rays_[i].bearing);
    gaps.push_back(rays_.front().bearing + turn - rays_.back().bearing);
    const auto widest = std::max_element(gaps.begin(), gaps.end());
    const auto first = static_cast<std::size_t>(widest - gaps.begin() + 1) % rays_.size();
    const double gap = *widest;
    for (std::size_t i = 0; i < first; ++i) rays_[i].bearing += turn;
    std::rotate(rays_.begin(), rays_.begin() + static_cast<std::ptrdiff_t>(first), rays_.end());

    const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>((gaps.size() - 1) / 2);
    std::nth_element(gaps.begin(), middle, gaps.end());
    const double narrowest_drawn = deg_to_rad(3);  // a lone beam stays visible
    spacing_ = rays_.size() > 1 ? *middle : std::max(rays_.front().width, narrowest_drawn);
    set_edges(gap);
}

void PolarScan::set_edges(double widest_gap) {
    full_turn_ = rays_.size() > 2 && widest_gap <= 2.01 * spacing_;
    begin_ = rays_.front().bearing;
    end_ = begin_ + turn;
    if (full_turn_) return;
    const auto margin = [this](std::size_t left) {
        if (rays_.size() < 2) return spacing_ / 2;
        const double gap = rays_[left + 1].bearing - rays_[left].bearing;
        return (neighbours(rays_[left], rays_[left + 1], gap) ? gap : spacing_) / 2;
    };
    begin_ -= margin(0);
    end_ = rays_.back().bearing + margin(rays_.size() - 2);
}

/// The beams of one ping are a fan without gaps; a head that pauses in its scan leaves one.
bool PolarScan::neighbours(const Ray& left, const Ray& right, double gap) const {
    return left.ping == right.ping || gap <= 2.01 * spacing_;
}

std::optional<PolarScan::Place> PolarScan::find(double bearing) const {
    const double b = wrapped(bearing, begin_);
    if (b > end_) return std::nullopt;
    const auto next = std::upper_bound(rays_.begin(), rays_.end(), b,
                                       [](double angle, const Ray& ray) { return angle < ray.bearing; });
    if (next == rays_.begin()) return Place{&rays_.front(), &rays_.front(), 0};
    const Ray& left = *(next - 1);
    if (next == rays_.end() && !full_turn_) return Place{&left, &left, 0};
    const Ray& right = next == rays_.end() ? rays_.front() : *next;
    const double gap = (next == rays_.end() ? right.bearing + turn : right.bearing) - left.bearing;
    const double from_left = b - left.bearing;
    if (neighbours(left, right, gap)) return Place{&left, &right, from_left / gap};
    if (from_left <= spacing_ / 2) return Place{&left, &left, 0};
    if (gap - from_left <= spacing_ / 2) return Place{&right, &right, 0};
    return std::nullopt;
}

bool PolarScan::covers(double bearing) const { return find(bearing).has_value(); }

double PolarScan::value(double range, double bearing, double extent) const {
    const auto place = find(bearing);
    if (!place) return 0;
    return (1 - place->weight) * along(*place->left, range, extent) +
           place->weight * along(*place->right, range, extent);
}

}  // namespace echoloop::draw
