// What the water does to a ping: how fast, how far and along which rays its sound goes.
#pragma once

#include <memory>
#include <optional>

#include "render/echogram.h"
#include "render/effects.h"
#include "render/fan/reverberation.h"
#include "render/gl/seen.h"
#include "render/paths/paths.h"
#include "render/ray_table.h"
#include "render/ray_tables.h"
#include "render/renderer_strengths.h"
#include "render/water.h"

namespace echoloop {

class PingWater {
  public:
    /// `effects`: of echoes; none with the paper's rule.
    PingWater(Water water, std::optional<WaterSurface> surface, Effects effects)
        : water_(std::move(water)), surface_(surface), effects_(effects) {}

    /// For a ping at a height, m. Where rays bend by half a bin or more, echoes come as they do.
    void begin(const Shot& shot, double z);

    const Water& water() const { return water_; }
    /// m/s: ranges are times at this speed.
    double speed() const { return speed_; }
    const std::shared_ptr<const RayTable>& rays() const { return rays_; }  ///< null: they are straight

    /// Np/m.
    double absorption(const Shot& shot) const;
    /// m, of the window.
    double end_range(const Shot& shot) const;
    /// As far as it depends on the water. `background`: of a faint one.
    gl::Outlook outlook(const Shot& shot, bool background) const;

    /// Fills `out`, unless the water is silent, and gives its surface a strength. What comes late of the ping
    /// before, whose detail is below 1, is far weaker than what this one's water sends back, and left out.
    void scatter(const Shot& shot, const Pose& world_from_sonar, double detail, SurfaceStrengths& strengths,
                 std::optional<Reverberation>& out) const;

  private:
    Water water_;
    std::optional<WaterSurface> surface_;
    Effects effects_;
    RayTables ray_tables_;
    double speed_ = 1500;
    std::shared_ptr<const RayTable> rays_, rays_nearby_;
};

}  // namespace echoloop
