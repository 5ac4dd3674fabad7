// Boxes, cylinders, cones, spheres and the like as triangles, about their own origin as SDF has them (metres,
// z up).
#pragma once

#include "tools/import/shape.h"

namespace echoloop::worlds {

Shape box(Vec3 size);
/// Along z, `length` from end to end.
Shape cylinder(double radius, double length);
/// About its middle, the tip upwards.
Shape cone(double radius, double length);
Shape ellipsoid(Vec3 radii);
/// A cylinder of `length` with half a ball at each end, along z.
Shape capsule(double radius, double length);
/// A rectangle about the origin, seen from where `normal` points to.
Shape plane(Vec3 normal, double length, double width);

}  // namespace echoloop::worlds
