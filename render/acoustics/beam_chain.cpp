#include "render/acoustics/beam_chain.h"

#include <algorithm>
#include <cmath>

#include "render/acoustics/chain.h"
#include "render/acoustics/chain_kernels.h"

namespace echoloop {
namespace {

double power_of(double db) { return std::pow(10, db / 10); }

/// Hz, over which what is left of the noise is even: a compressed chirp's has the whole sweep.
double noise_spectrum(const Shot& shot) {
    return shot.bandwidth > 0 ? shot.bandwidth : noise_bandwidth(shot);
}

/// uPa^2; less changes no level, and is what receivers have whose noise somebody else adds.
constexpr double least_noise = 1e-12;

}  // namespace

ChainPlan::ChainPlan(const Shot& shot, double sound_speed, Effects effects, SpeckleOptions options)
    : bins(shot.bins),
      first_range(sound_speed / 2 * shot.first_bin_time),
      bin_length(sound_speed / 2 * shot.bin_interval),
      pulse(effects.has(Effect::pulse) && range_resolution(shot, sound_speed) > 0),
      speckle(effects.has(Effect::speckle)),
      shape(shot, sound_speed),
      grid(shot),
      lean(shot, grid.cell_width()) {
    if (pulse) {
        power = power_filter(shape, bin_length);
        looks = std::max(1.0, bin_length / shape.length());
        fine = bin_length < shape.length();
        if (fine) field = field_filter(shape, bin_length);
        texture_bins = static_cast<std::size_t>(std::max(1.0, std::round(shape.length() / bin_length)));
    }
    if (effects.has(Effect::noise)) noise_power = received_noise(shot);
    if (effects.has(Effect::quantisation)) noise_power += converter_noise(shot);
    if (noise_power < least_noise) noise_power = 0;
    if (noise_power > 0) {
        noise_looks = pulse ? std::max(1.0, noise_spectrum(shot) * shot.bin_interval) : 1;
        if (fine) noise = noise_filter(noise_spectrum(shot), shot.bin_interval);
    }
    if (speckle) texture_shape = options.shape;
    if (effects.has(Effect::saturation))
        power_limit = static_cast<float>(power_of(shot.receiver.saturation_level));
}

void BeamChain::start(const ChainPlan& plan, const ChainPing& ping) {
    plan_ = &plan;
    ping_ = ping;
    for (Field& field : fields_) field.cell = ~0U;
    for (Field* field : {&speckle_, &noise_, &points_}) make_room(*field);
    looks_.resize(plan.bins);
    cosines_.resize(plan.bins);
}

void BeamChain::make_room(Field& field) const {
    field.real.resize(random_room(plan_->bins));
    field.imaginary.resize(random_room(plan_->bins));
}

void BeamChain::run(std::size_t beam, std::span<const PointEcho> points, std::span<const float> means,
                    std::span<float> values) {
    if (plan_->leans())
        std::copy_n(means.begin() + static_cast<std::ptrdiff_t>(beam * plan_->bins), plan_->bins,
                    values.begin());
    else
        spread(values, values);
    const AngularCells cells = plan_->grid.cells_of(ping_.view.turn + ping_.pan + ping_.bearings[beam]);
    const Field* field = plan_->speckle ? &speckle_of(beam, cells, means) : nullptr;
    if (std::isfinite(plan_->texture_shape)) modulate_texture(cells, values);
    const bool has_points = add_points(points);
    if (plan_->fine) {
        fine_echo(beam, field, has_points, values);
    } else {
        coarse_echo(cells, field, has_points, values);
        if (plan_->noise_power > 0) coarse_noise(beam, values);
    }
    kernels::receive(plan_->power_limit, values.size(), values.data());
}

void BeamChain::spread(std::span<const float> values, std::span<float> means) {
    const LineFilter& filter = plan_->power;
    if (filter.is_identity()) {
        if (means.data() != values.data()) std::copy(values.begin(), values.end(), means.begin());
        return;
    }
    padded_.assign(filter.room(values.size()), 0.0F);
    std::copy(values.begin(), values.end(), padded_.begin() + static_cast<std::ptrdiff_t>(filter.before()));
    filter.apply(padded_, values.size(), means.data(), scratch_);
}

void BeamChain::modulate_texture(const AngularCells& cells, std::span<float> values) {
    const std::uint32_t cell = cells.first_weight >= cells.second_weight ? cells.first : cells.second;
    const RandomStream stream = view_stream(cell, texture);
    for (std::size_t i = 0; i < values.size(); i += plan_->texture_bins) {
        const auto index = static_cast<std::uint32_t>(i / plan_->texture_bins);
        const auto factor = static_cast<float>(random_gamma(stream, index, plan_->texture_shape));
        for (std::size_t k = i; k < std::min(i + plan_->texture_bins, values.size()); ++k)
            values[k] *= factor;
    }
}

bool BeamChain::add_points(std::span<const PointEcho> points) {
    if (points.empty()) return false;
    std::fill(points_.real.begin(), points_.real.end(), 0.0F);
    std::fill(points_.imaginary.begin(), points_.imaginary.end(), 0.0F);
    for (const PointEcho& point : points) place(point, point.range - plan_->first_range);
    return true;
}

/// `where`: m from the window's beginning.
void BeamChain::place(const PointEcho& point, double where) {
    const double length = plan_->bin_length, last_bin = static_cast<double>(plan_->bins) - 1;
    const double begin = plan_->pulse ? plan_->shape.begin() : 0, end = plan_->pulse ? plan_->shape.end() : 0;
    const double first = std::max(std::floor((where + begin) / length), 0.0);
    const double last = std::min(std::floor((where + end) / length), last_bin);
    const double cosine = std::cos(point.phase), sine = std::sin(point.phase);
    for (double bin = first; bin <= last; ++bin) {
        const double from = bin * length - where;
        const double share =
            plan_->pulse
                ? (plan_->shape.energy_until(from + length) - plan_->shape.energy_until(from)) / length
                : 1;
        const double amplitude = std::sqrt(point.power * std::max(share, 0.0));
        points_.real[static_cast<std::size_t>(bin)] += static_cast<float>(amplitude * cosine);
        points_.imaginary[static_cast<std::size_t>(bin)] += static_cast<float>(amplitude * sine);
    }
}

RandomStream BeamChain::view_stream(std::uint32_t cell, std::uint32_t kind) const {
    return {ping_.key, ping_.view.place, cell, kind};
}

RandomStream BeamChain::noise_stream(std::size_t beam, std::uint32_t kind) const {
    return {ping_.key, ping_.ping, static_cast<std::uint32_t>(beam), kind};
}

void BeamChain::fill_field(const LineFilter& filter, const RandomStream& stream, Field& out) {
    if (filter.is_identity())
        return complex_normals(stream, plan_->bins, out.real.data(), out.imaginary.data());
    const std::size_t count = filter.before() + plan_->bins;
    const std::size_t room = std::max(filter.room(plan_->bins), random_room(count));
    padded_.resize(room);
    padded_imaginary_.resize(room);
    complex_normals(stream, count, padded_.data(), padded_imaginary_.data());
    filter.apply(padded_, plan_->bins, out.real.data(), scratch_);
    filter.apply(padded_imaginary_, plan_->bins, out.imaginary.data(), scratch_);
}

void BeamChain::fine_echo(std::size_t beam, const Field* field, bool points, std::span<float> values) {
    const std::size_t n = values.size();
    const bool noisy = plan_->noise_power > 0;
    if (!field) {
        if (points) kernels::add_intensity(points_.real.data(), points_.imaginary.data(), n, values.data());
        if (!noisy) return;
    }
    float *real = speckle_.real.data(), *imaginary = speckle_.imaginary.data();
    if (field) {
        kernels::modulate(values.data(), field->real.data(), field->imaginary.data(), n, real, imaginary);
        if (points) kernels::add(1, points_.real.data(), points_.imaginary.data(), n, real, imaginary);
    } else {
        kernels::square_root(values.data(), n, real);
        std::fill_n(imaginary, n, 0.0F);
    }
    if (noisy) {
        fill_field(plan_->noise, noise_stream(beam, noise), noise_);
        kernels::add(static_cast<float>(std::sqrt(plan_->noise_power)), noise_.real.data(),
                     noise_.imaginary.data(), n, real, imaginary);
    }
    kernels::intensity(real, imaginary, n, values.data());
}

void BeamChain::coarse_echo(const AngularCells& cells, const Field* field, bool points,
                            std::span<float> values) {
    if (field) kernels::multiply(field->real.data(), values.size(), values.data());
    if (!points) return;
    if (field) coarse_points(cells, values);
    kernels::add_intensity(points_.real.data(), points_.imaginary.data(), values.size(), values.data());
}

/// A point echo lies in one of a bin's looks, and interferes with that one.
void BeamChain::coarse_points(const AngularCells& cells, std::span<float> values) const {
    const RandomStream stream = view_stream(cells.first, speckle_phase);
    const double per_look = 1 / plan_->looks;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (points_.real[i] == 0 && points_.imaginary[i] == 0) continue;
        const auto [cosine, sine] = random_direction(stream, static_cast<std::uint32_t>(i));
        const auto diffuse = static_cast<float>(std::sqrt(static_cast<double>(values[i]) * per_look));
        const float cross = 2 * diffuse * (points_.real[i] * cosine + points_.imaginary[i] * sine);
        // Not below what the added intensity of the point brings back to 0.
        const float point = points_.real[i] * points_.real[i] + points_.imaginary[i] * points_.imaginary[i];
        values[i] = std::max(values[i] + cross, -point);
    }
}

void BeamChain::coarse_noise(std::size_t beam, std::span<float> values) {
    mean_of_looks(noise_stream(beam, noise), plan_->noise_looks, values.size(), looks_.data());
    random_cosines(noise_stream(beam, noise_phase), values.size(), cosines_.data());
    const double looks = plan_->speckle ? std::max(plan_->looks, plan_->noise_looks) : plan_->noise_looks;
    kernels::interfere(1, values.data(), static_cast<float>(plan_->noise_power), looks_.data(),
                       cosines_.data(), static_cast<float>(looks), values.size());
}

}  // namespace echoloop
