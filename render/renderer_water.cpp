#include "render/renderer_water.h"

#include "render/refraction.h"
#include "render/view.h"

namespace echoloop {

void PingWater::begin(const Shot& shot, double z) {
    speed_ = sound_speed(water_), rays_ = nullptr;
    if (!effects_.has(Effect::refraction) || water_.profile.empty()) return;
    const double depth = surface_.value_or(WaterSurface{}).height - z;
    speed_ = sound_speed_at(water_.profile, depth_step(depth));
    const double range = end_range(shot), half_bin = speed_ / 4 * shot.bin_interval;
    rays_ = ray_tables_.of(water_.profile, depth, range, surface_.has_value());
    if (rays_->straight_error(range) < half_bin)
        rays_ = nullptr;
    else
        rays_nearby_ = ray_tables_.nearby(water_.profile, depth, range, surface_.has_value());
}

double PingWater::absorption(const Shot& shot) const {
    return effects_.has(Effect::absorption) ? db_to_neper(absorption_db_per_km(water_, shot.frequency) / 1e3)
                                            : 0;
}

double PingWater::end_range(const Shot& shot) const {
    return speed_ / 2 * (shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval);
}

gl::Outlook PingWater::outlook(const Shot& shot, bool background) const {
    // Of nothing nearer a pulse still sounds in the window.
    const double begin_range = speed_ / 2 * (shot.first_bin_time - shot.pulse_length);
    return {.world_from_fan = {},
            .end_range = end_range(shot),
            .begin_range = background ? begin_range : 0,
            .rays = rays_,
            .rays_nearby = rays_nearby_,
            .sag = speed_ / 8 * shot.bin_interval};
}

void PingWater::scatter(const Shot& shot, const Pose& world_from_sonar, double detail,
                        SurfaceStrengths& strengths, std::optional<Reverberation>& out) const {
    out.reset();
    const double z = world_from_sonar.position.z;
    const auto surface = surface_ && z < surface_->height ? surface_ : std::nullopt;
    const double wind = surface_ ? surface_->wind : 0;
    if (!effects_.has(Effect::reverberation) || detail < 1) return;
    if (water_.scattering.empty() && !(surface && wind > 0)) return;
    const std::size_t number = strengths.add_water_surface(shot.frequency, wind);
    const Quat world_from_fan = world_from_sonar.orientation * sonar_from_fan(shot.pan, shot.tilt);
    WaterAround around{.up = rotate(conjugate(world_from_fan), {0, 0, 1}),
                       .depth = surface ? surface->height - z : water_.depth,
                       .surface_number = static_cast<float>(number),
                       .scattering = water_.scattering,
                       .near = near_ranges(shot, speed_ / shot.frequency),
                       .rays = rays_.get()};
    if (surface) around.surface = surface->height - z;
    out.emplace(around, speed_ / 2 * shot.first_bin_time, speed_ / 2 * shot.bin_interval, shot.bins);
}

}  // namespace echoloop
