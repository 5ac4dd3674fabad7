// Writes a world as a binary glTF 2.0 file (.glb) that the emulator's scene reader accepts. Reads nothing.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "tools/import/world.h"

namespace echoloop::worlds {

/// Positions become floats, z up becomes y up; the origin goes into `scenes[0].extras.origin`, {"latitude",
/// "longitude", "height"}. Surfaces without triangles are left out. Throws std::runtime_error that says why,
/// for a world that no scene can hold (positions beyond 100 km, too many triangles, indices out of range) and
/// when writing fails.
void write_glb(const World& world, std::ostream& out);
void write_glb(const World& world, const std::filesystem::path& file);

}  // namespace echoloop::worlds
