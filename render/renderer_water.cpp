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

double PingWater::begin_range(const Shot& shot) const {
    return speed_ / 2 * (shot.first_bin_time - shot.pulse_length);
}

}  // namespace echoloop
