// Reads the files of one scene. Gives only regular files inside the scene's folder; never opens a FIFO or a
// device and never follows a link out of the folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace echoloop {

class SceneFolder {
  public:
    using Bytes = std::vector<unsigned char>;

    /// Throws SceneFault when the scene file does not exist or is not a regular file.
    explicit SceneFolder(const std::filesystem::path& scene_file);

    /// The scene file itself; throws SceneFault when it is longer than `limit`.
    Bytes read_scene(std::size_t limit) const;

    /// The first `size` bytes of the file that a relative, percent-encoded glTF URI names. Throws SceneFault
    /// with `place` when the URI leaves the folder or the file is missing, not regular or shorter.
    Bytes read(const std::string& uri, std::size_t size, const std::string& place) const;

  private:
    std::filesystem::path file_, folder_;
};

}  // namespace echoloop
