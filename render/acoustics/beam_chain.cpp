#include "render/acoustics/beam_chain.h"

#include <algorithm>
#include <cmath>

#include "render/acoustics/chain_kernels.h"

namespace echoloop {
namespace {

double power_of(double db) { return std::pow(10, db / 10); }

/// uPa^2; less changes no level, and is what receivers have whose noise somebody else adds.
constexpr double least_noise = 1e-12;

Scatter scatter_of(const RangeCorrelation& correlation, const Receiver& receiver, double bin_length) {
    Scatter out;
    if (receiver.bins != BinRule::sample)
        out.looks = std::min(looks_in(correlation, bin_length), receiver.most_looks);
    out.bins = bin_filter(correlation, receiver.bins, out.looks, bin_length);
    out.neighbours = neighbour_correlation(out.bins);
    return out;
}

/// Whether all beams are two widths apart or more, where they share nothing.
bool far_apart(const Shot& shot) {
    for (std::size_t i = 1; i < shot.bearings.size(); ++i)
        if (shot.bearings[i] - shot.bearings[i - 1] < 2 * shot.beam_width) return false;
    return true;
}

}  // namespace

ChainPlan::ChainPlan(const Shot& shot, double sound_speed, Effects effects, SpeckleOptions options)
    : bins(shot.bins),
      first_range(sound_speed / 2 * shot.first_bin_time),
      bin_length(sound_speed / 2 * shot.bin_interval),
      pulse(effects.has(Effect::pulse) && range_resolution(shot, sound_speed) > 0),
      speckle(effects.has(Effect::speckle)),
      keeps_peaks(shot.receiver.bins == BinRule::peak),
      shape(shot, sound_speed),
      grid(shot.beam_width),
      lean(shot, grid.cell_width()),
      shares_noise(!far_apart(shot)),
      ring_down(shot, effects),
      interference(shot, effects) {
    if (effects.has(Effect::noise)) noise_power = received_noise(shot);
    if (effects.has(Effect::quantisation)) noise_power += converter_noise(shot);
    if (noise_power < least_noise) noise_power = 0;
    if (effects.has(Effect::saturation))
        power_limit = static_cast<float>(power_of(shot.receiver.saturation_level));
    const BinRule rule = shot.receiver.bins;
    Shot upright = shot;
    upright.horizontal = shot.vertical;
    if (pulse) {
        power = power_filter(shape, bin_length);
        power_gain = shape.energy_until(shape.end()) / bin_length;
        bins_per_look = static_cast<std::size_t>(std::max(1.0, std::round(shape.length() / bin_length)));
        if (speckle) echo = scatter_of(echo_correlation(shot, sound_speed), shot.receiver, bin_length);
        if (noise_power > 0) {
            noise = scatter_of(noise_correlation(shot, sound_speed), shot.receiver, bin_length);
            if (shot.receiver.noise_circuit > 0) {
                noise.bins = tuned_filter(shot.receiver.noise_circuit, sound_speed, bin_length);
                noise.neighbours = neighbour_correlation(noise.bins);
            }
        }
    }
    if (speckle) {
        echo.kernel = echo_kernel(shot, echo.looks);
        echo.upright = echo_kernel(upright, echo.looks);
        echo.law = bin_law(rule, echo.looks);
        texture_shape = options.shape;
        if (textured()) texture = gamma_law(texture_shape);
    }
    if (noise_power > 0) {
        noise.kernel = noise_kernel(shot, noise.looks);
        noise.upright = noise_kernel(upright, noise.looks);
        noise.law = bin_law(rule, noise.looks);
    }
}

void BeamChain::start(const ChainPlan& plan, const ChainPing& ping) {
    plan_ = &plan;
    ping_ = ping;
    for (Fields& fields : fields_) {
        for (Field& field : fields.of_cells) field.cell = ~0U;
        fields.heard.resize(plan.bins);
    }
    if (ping.rows.empty()) return;
    for (RowFields& fields : of_rows_) {
        if (ping.first_row) fields.clear();
        fields.keep_from(ping.rows.front().share.row);
    }
}

/// Of the beams that this one's speckle depends on.
void BeamChain::find_means(std::size_t beam, const Before& before) {
    const auto [first, last] = plan_->lean.lean_on(beam);
    if (next_mean_ == none) next_mean_ = first;
    for (; next_mean_ <= last; ++next_mean_) {
        std::vector<float>& means = means_.of(next_mean_);
        means.resize(plan_->bins);
        spread(before(next_mean_), means);
    }
}

void BeamChain::run(std::size_t beam, std::span<const PointEcho> points, const Before& before,
                    const FreshPower& fresh, std::span<float> values) {
    const ChainPlan& plan = *plan_;
    std::span<const float> means;
    if (plan.leans()) {
        find_means(beam, before);
        means = means_.of(beam);
    } else {
        own_means_.resize(values.size());
        spread(values, own_means_);
        means = own_means_;
    }
    const double place = plan.grid.place_of(ping_.view.turn() + ping_.pan + ping_.bearings[beam]);
    if (plan.speckle) {
        const float* echo = speckle_of(beam, place);
        const bool as_noise = plan.fresh_is_noise();
        if (!fresh.steps.empty() && !as_noise) renew_speckle(beam, fresh, means);
        if (plan.textured()) {
            hear(texture, cells_at(texture, place), {0, plan.bins});
            textured_.assign(means.begin(), means.end());
            kernels::multiply_by_law(plan.texture.root.data(), fields_[texture].heard.data(), plan.bins,
                                     textured_.data());
            means = textured_;
        }
        const float* of_noise = plan.noise_power > 0 ? noise_of(beam) : echo;
        scatter_with_noise(means, echo, of_noise, as_noise ? fresh : FreshPower{}, values);
    } else {
        std::ranges::copy(means, values.begin());
        if (plan.noise_power > 0) steady_in_noise(beam, values);
    }
    if (add_points(points)) interfere_with_points(place, values);
    const LineKey line{ping_.key, ping_.ping, static_cast<std::uint32_t>(beam),
                       ping_.pan + ping_.bearings[beam]};
    plan.interference.add(line, plan.noise_power, values);
    plan.ring_down.add(line, ping_.source_level, values);
    kernels::receive(plan.power_limit, values.size(), values.data());
}

/// `fresh`: what has the noise's numbers.
void BeamChain::scatter_with_noise(std::span<const float> means, const float* echo, const float* of_noise,
                                   const FreshPower& fresh, std::span<float> values) {
    const ChainPlan& plan = *plan_;
    spread_steps(fresh);
    kernels::scatter({echo, plan.echo.law.root.data()}, {of_noise, plan.noise.law.root.data()},
                     {static_cast<float>(plan.noise_power), fresh_.data()}, plan.bins, means.data(),
                     values.data());
}

/// Into fresh_, after the pulse: a step has one power.
void BeamChain::spread_steps(const FreshPower& fresh) {
    fresh_.resize(plan_->bins);
    std::size_t first = 0;
    for (std::size_t k = 0; k < fresh.steps.size() && first < fresh_.size(); ++k) {
        const std::size_t bins = std::min(fresh.bins_per_step, fresh_.size() - first);
        std::fill_n(&fresh_[first], bins, static_cast<float>(plan_->power_gain) * fresh.steps[k]);
        first += bins;
    }
    std::fill(fresh_.begin() + static_cast<std::ptrdiff_t>(first), fresh_.end(), 0.0F);
}

void BeamChain::spread(std::span<const float> values, std::span<float> means) {
    const LineFilter& filter = plan_->power;
    if (filter.is_identity()) return void(std::ranges::copy(values, means.begin()));
    if (filter.is_short()) return filter.filter(values, means.data());
    padded_.assign(filter.room(values.size()), 0.0F);
    std::copy(values.begin(), values.end(), padded_.begin() + static_cast<std::ptrdiff_t>(filter.before()));
    filter.apply(padded_, values.size(), means.data(), scratch_);
}

/// Without speckle the echo is steady: its interference with the noise has a new phase in every bin.
void BeamChain::steady_in_noise(std::size_t beam, std::span<float> values) {
    places_.assign(values.size(), static_cast<float>(plan_->noise_power));
    kernels::multiply_by_law(plan_->noise.law.root.data(), noise_of(beam), values.size(), places_.data());
    cosines_.resize(values.size());
    random_cosines({ping_.key, ping_.ping, static_cast<std::uint32_t>(beam), noise_phase}, values.size(),
                   cosines_.data());
    kernels::interfere(places_.data(), cosines_.data(), static_cast<float>(plan_->noise.looks), values.size(),
                       values.data());
}

bool BeamChain::add_points(std::span<const PointEcho> points) {
    with_points_ = {plan_->bins, 0};
    for (const PointEcho& point : points) {
        const Part bins = bins_of(point);
        if (bins.count == 0) continue;
        const std::size_t end = with_points_.first + with_points_.count;
        const std::size_t first = std::min(with_points_.first, bins.first);
        with_points_ = {first, std::max(with_points_.count > 0 ? end : 0, bins.first + bins.count) - first};
    }
    if (with_points_.count == 0) return false;
    points_real_.assign(with_points_.count, 0.0F);
    points_imaginary_.assign(with_points_.count, 0.0F);
    for (const PointEcho& point : points) place_point(point);
    return true;
}

/// Where its pulse lies in the window.
BeamChain::Part BeamChain::bins_of(const PointEcho& point) const {
    const double where = point.range - plan_->first_range, length = plan_->bin_length;
    const double begin = plan_->pulse ? plan_->shape.begin() : 0, end = plan_->pulse ? plan_->shape.end() : 0;
    const double first = std::max(std::floor((where + begin) / length), 0.0);
    const double last = std::min(std::floor((where + end) / length), static_cast<double>(plan_->bins) - 1);
    if (!(first <= last)) return {};
    return {static_cast<std::size_t>(first), static_cast<std::size_t>(last - first) + 1};
}

/// Of a point's power, what is in a bin that begins at offset `from` m against its range: the mean over the
/// bin, or over the part of it that the pulse fills where bins keep the peak.
double BeamChain::share_of(double from) const {
    if (!plan_->pulse) return 1;
    const PulseShape& shape = plan_->shape;
    const double to = from + plan_->bin_length;
    const double energy = std::max(shape.energy_until(to) - shape.energy_until(from), 0.0);
    const double mean = energy / plan_->bin_length;
    if (!plan_->keeps_peaks) return mean;
    const double begin = shape.is_chirp() ? -shape.length() / 2 : 0, end = begin + shape.length();
    const double filled = std::min(to, end) - std::max(from, begin);
    return filled > 0 ? std::min(energy / filled, 1.0) : mean;
}

void BeamChain::place_point(const PointEcho& point) {
    const double where = point.range - plan_->first_range;
    const double cosine = std::cos(point.phase), sine = std::sin(point.phase);
    const Part bins = bins_of(point);
    for (std::size_t bin = bins.first; bin < bins.first + bins.count; ++bin) {
        const double from = static_cast<double>(bin) * plan_->bin_length - where;
        const double amplitude = std::sqrt(point.power * share_of(from));
        points_real_[bin - with_points_.first] += static_cast<float>(amplitude * cosine);
        points_imaginary_[bin - with_points_.first] += static_cast<float>(amplitude * sine);
    }
}

/// A point echo lies in one of a bin's looks, and interferes with that one, whose phase lasts for a pulse.
void BeamChain::interfere_with_points(double place, std::span<float> values) const {
    const RandomStream stream{ping_.key, ping_.view.key(), static_cast<std::uint32_t>(place), point_phase};
    const double per_look = 1 / plan_->echo.looks;
    const bool diffuse = plan_->speckle;
    for (std::size_t k = 0, i = with_points_.first; k < with_points_.count; ++k, ++i) {
        const float real = points_real_[k], imaginary = points_imaginary_[k];
        if (real == 0 && imaginary == 0) continue;
        float cross = 0;
        if (diffuse) {
            const auto [cosine, sine] =
                random_direction(stream, static_cast<std::uint32_t>(i / plan_->bins_per_look));
            const auto amplitude = static_cast<float>(std::sqrt(static_cast<double>(values[i]) * per_look));
            cross = 2 * amplitude * (real * cosine + imaginary * sine);
        }
        values[i] = std::max(values[i] + cross + real * real + imaginary * imaginary, 0.0F);
    }
}

}  // namespace echoloop
