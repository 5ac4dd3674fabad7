// Scenes, shots and measurements that the checks share: made in memory, with effects chosen one by one. Knows
// no published value.
#pragma once

#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "render/renderer.h"
#include "render/scene/shapes.h"

namespace echoloop::validation {

using shapes::floor_at;
using shapes::sphere;
using shapes::wall_at;

/// A floor with corners that lie higher or lower, each by a normal number of its own times `height` (m).
Mesh rough_floor_at(double z, double half_x, double half_y, double cell, double height);
std::shared_ptr<const Scene> scene_of(std::vector<Mesh> meshes, std::vector<PointTarget> targets = {});

Water water_of(double sound_speed);
Effects only(std::initializer_list<Effect> effects);
RendererOptions with(Effects effects);

/// `beams` beams side by side over a window of 0 to `range` m; a CW pulse as long as a bin, at c = 1500 m/s.
Shot fan(double aperture_deg, double height_deg, std::size_t beams, std::size_t bins, double range);

/// A beam of 2 x 2 deg with bins of a quarter of the pulse from 0 to `range` m, so that an echo fills some of
/// them wholly.
Shot pencil(double range, double pulse_length);

double db(double power);
double total(std::span<const float> values);
double peak(std::span<const float> values);
std::size_t peak_bin(std::span<const float> values);
/// The first bin that is louder than `share` of the loudest; the number of bins if there is none.
std::size_t first_bin(std::span<const float> values, double share);

/// Sum of the echograms of `pings` pings, the sonar a little further on at each, as doubles.
std::vector<double> mean_values(Renderer& renderer, Shot shot, std::size_t pings,
                                Vec3 step = {0.37, 0.29, 0});

}  // namespace echoloop::validation
