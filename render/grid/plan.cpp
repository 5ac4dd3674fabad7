#include "render/grid/plan.h"

#include <algorithm>
#include <cmath>

#include "render/fan/far_lobes.h"
#include "render/grid/field.h"
#include "render/grid/lobes.h"

namespace echoloop {

GridGeometry grid_geometry_of(const Shot& shot, const Effects& effects) {
    return {geometry_of(shot, effects), shot.elevations};
}

GridPlan plan_grid(const GridGeometry& g, const PlanDensity& density) {
    GridPlan plan;
    plan.columns = g.row.bearings.size(), plan.rows = g.elevations.size();
    plan.across.reserve(plan.columns * plan.rows);
    for (const double elevation : g.elevations)
        for (const double bearing : g.row.bearings) plan.across.push_back(cone_angle(bearing, elevation));
    const GridLobes lobes(g.row);
    const FieldLimits limits = limits_of(g, lobes);
    add_field(plan, g, lobes, limits, density);
    if (g.row.side_lobes) add_grid_far(plan, g, lobes, limits, density.pixels);
    return plan;
}

}  // namespace echoloop
