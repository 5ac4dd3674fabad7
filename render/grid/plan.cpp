#include "render/grid/plan.h"

#include "render/fan/far_lobes.h"
#include "render/grid/field.h"

namespace echoloop {

GridPlan::GridPlan(const FanGeometry& rows_of_beams)
    : lobes(rows_of_beams), columns(rows_of_beams.bearings.size()), rows(rows_of_beams.elevations.size()) {
    geometry = rows_of_beams;
    axes.reserve(columns * rows);
    for (const double elevation : geometry.elevations)
        for (const double bearing : geometry.bearings) axes.push_back(cone_angle(bearing, elevation));
}

GridPlan plan_grid(const FanGeometry& geometry, const PlanDensity& density) {
    GridPlan plan(geometry);
    const FieldLimits limits = limits_of(plan);
    add_field(plan, limits, density);
    if (geometry.side_lobes) add_grid_far(plan, limits, density.pixels);
    plan.bytes = plan.heard.size() * sizeof(Heard) + plan.first_heard.size() * sizeof(std::uint32_t) +
                 plan.far.shares.size() * sizeof(FarShare) +
                 plan.axes.size() * (sizeof(double) + 4 * sizeof(float));
    return plan;
}

}  // namespace echoloop
