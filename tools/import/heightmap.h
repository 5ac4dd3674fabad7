// Heightmaps of images as Gazebo reads them. DEMs are terrain of another kind.
#pragma once

#include <filesystem>

#include "tools/import/shape.h"

namespace echoloop::worlds {

/// The image's middle lies at `position`, its top is north (+y); `size` is its extent, with the height of the
/// brightest pixel. At most 2048 samples a side are kept. Throws Fault.
Shape read_heightmap(const std::filesystem::path& file, Vec3 size, Vec3 position);

}  // namespace echoloop::worlds
