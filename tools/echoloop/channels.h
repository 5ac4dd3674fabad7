// The three channels behind a rendered ping (Cerqueira et al. 2016) as a NumPy file. Renders nothing.
#pragma once

#include <filesystem>

#include "render/renderer.h"

namespace echoloop::cli {

/// float32, little endian, shape 3 x height x width: intensity (0..1), range (m, NaN: nothing), bearing
/// (rad). Throws std::runtime_error.
void write_channels_npy(const std::filesystem::path& path, const ChannelImage& image);

}  // namespace echoloop::cli
