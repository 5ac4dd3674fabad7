// Finds the files that a world names, in the folders that the user named and nowhere else. Opens none of
// them.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace echoloop::worlds {

/// Something that a world names and that is nowhere. what() says where it was looked for and how to get it.
class Missing : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

class ModelPaths {
  public:
    /// `world` is the file; its folder counts, too. `folders` may hold lists separated by colons. Fuel's
    /// caches are folders as Gazebo leaves them. Throws Fault for a folder that does not exist.
    ModelPaths(const std::filesystem::path& world, const std::vector<std::string>& folders,
               std::vector<std::filesystem::path> fuel_caches);

    enum class Kind { file, folder_or_file };
    /// The canonical path of what a URI means in a file of the folder `from`: model://, package://, file://,
    /// Fuel's https://, or a path. Throws Missing; throws Fault when it leads out of all folders, be it by ..
    /// or by a link.
    std::filesystem::path find(const std::string& uri, const std::filesystem::path& from, Kind kind) const;

    /// Whether a file, after all links, lies in one of the folders.
    bool holds(const std::filesystem::path& file) const;

  private:
    std::vector<std::filesystem::path> candidates(const std::string& uri,
                                                  const std::filesystem::path& from) const;
    std::vector<std::filesystem::path> in_folders(const std::string& rest) const;
    std::vector<std::filesystem::path> in_caches(const std::string& uri) const;
    std::string advice(const std::string& uri) const;

    std::vector<std::filesystem::path> folders_, caches_;
};

/// Where Gazebo keeps what it fetched from Fuel on this machine, as far as it is there.
std::vector<std::filesystem::path> local_fuel_caches();

/// What GZ_SIM_RESOURCE_PATH and its older names hold.
std::vector<std::string> folders_of_environment();

}  // namespace echoloop::worlds
