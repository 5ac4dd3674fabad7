// A file that appears complete or not at all: written under a temporary name beside it, then renamed.
#pragma once

#include <filesystem>
#include <functional>

namespace echoloop::cli {

/// Throws StartError (cannot_create) if a file cannot be made there, before any work is done. Leaves nothing.
void require_creatable(const std::filesystem::path& file);

/// Calls `write` with the temporary name, then renames. Throws StartError (io) with the reason if either
/// fails, and then has left nothing.
void write_whole(const std::filesystem::path& file,
                 const std::function<void(const std::filesystem::path&)>& write);

}  // namespace echoloop::cli
