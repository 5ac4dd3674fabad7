// The triangles of what libsdformat calls a geometry.
#pragma once

#include <sdf/Geometry.hh>

#include <map>
#include <string>
#include <vector>

#include "tools/import/model_paths.h"
#include "tools/import/shape.h"
#include "tools/import/sources.h"

namespace echoloop::worlds {

/// Of the same key, the same shape.
std::string key_of(const sdf::Geometry& geometry);

/// Shapes by what they are made from, so that a mesh that is there a hundred times is read once.
class Shapes {
  public:
    /// `notes`: what was taken from files, and what was guessed.
    Shapes(const Sources& sources, const ModelPaths& paths, std::vector<std::string>& notes)
        : sources_(sources), paths_(paths), notes_(notes) {}

    /// `key` is the geometry's. Throws Fault.
    const Shape& get(const sdf::Geometry& geometry, const std::string& key);

  private:
    Shape made(const sdf::Geometry& geometry) const;
    Shape mesh(const sdf::Mesh& mesh) const;

    const Sources& sources_;
    const ModelPaths& paths_;
    std::vector<std::string>& notes_;
    std::map<std::string, Shape> shapes_;
};

}  // namespace echoloop::worlds
