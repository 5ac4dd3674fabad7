// glTF files for tests: a folder that vanishes with its owner, and a small valid document to change and to
// break.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace echoloop::test {

class TemporaryFolder {
  public:
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    std::filesystem::path write(const std::string& name, const std::string& bytes) const;

  private:
    std::filesystem::path path_;
};

/// Little-endian floats followed by 16-bit indices: a 2 x 1 m rectangle in the glTF plane z = 0, facing +z.
std::string rectangle_bytes();

/// A document with one node, mesh and material over rectangle_bytes() in "mesh.bin".
nlohmann::json rectangle_document();

/// The document and its bytes as a binary container. The first buffer loses its uri.
std::string as_glb(nlohmann::json document, const std::string& bytes);

/// The document with its first buffer embedded as a data: URI.
nlohmann::json embedded(nlohmann::json document, const std::string& bytes);

}  // namespace echoloop::test
