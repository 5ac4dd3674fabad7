// The steps in which plan_grid() makes a plan. Used by the planning code only.
#pragma once

#include "render/grid/plan.h"

namespace echoloop {

/// rad; directions between them are drawn finely.
struct FieldLimits {
    double left, right, bottom, top;

    bool contains(double bearing, double elevation) const {
        return bearing > left && bearing < right && elevation > bottom && elevation < top;
    }
};

FieldLimits limits_of(const GridPlan& plan);
/// Appends views of the field, and finds who hears their pixels.
void add_field(GridPlan& plan, const FieldLimits& limits, const PlanDensity& density);
/// Appends views of what is around the field, and finds what beams hear through side lobes.
void add_grid_far(GridPlan& plan, const FieldLimits& limits, double density);

}  // namespace echoloop
