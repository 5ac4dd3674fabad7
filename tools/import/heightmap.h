// Heightmaps as Gazebo reads them: images, and models of terrain in metres.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/import/shape.h"

namespace echoloop::worlds {

/// The middle lies at `position`, the top is north (+y). Of an image, `size` is its extent, with the height
/// of the brightest pixel, and at most 2048 samples a side are kept. A model of terrain (GDAL) has its own
/// extent and heights without a size, else its extent and the difference of its heights are made so; `notes`
/// says what was taken. Throws Fault.
Shape read_heightmap(const std::filesystem::path& file, std::optional<Vec3> size, Vec3 position,
                     std::vector<std::string>& notes);

}  // namespace echoloop::worlds
