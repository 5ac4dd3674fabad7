// Reads the way of a vehicle from a file: CSV with a header, or TUM (t x y z qx qy qz qw, as SLAM tools write
// it). World is ENU, bodies are FLU, metres and seconds.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "emulator/pose/track.h"
#include "render/geographic.h"

namespace echoloop {

/// Time 0 of the track is the first row. CSV: t,x,y,z,qw,qx,qy,qz with or without that header; a header may
/// name the columns in another order, and may have latitude,longitude,altitude (degrees, m above the sea) for
/// x,y,z where the world's origin is known. TUM: the same numbers separated by blanks, w last; # begins a
/// comment. Throws StartError (no_input, no_permission, data) with file, line and reason: rows that are no
/// numbers, times that do not grow, quaternions that are none, more than ten million rows.
Track read_trajectory(const std::filesystem::path& file, const std::optional<GeoPlace>& origin = {});

/// The same from text; `name` is for messages.
Track parse_trajectory(std::string_view text, const std::string& name,
                       const std::optional<GeoPlace>& origin = {});

}  // namespace echoloop
