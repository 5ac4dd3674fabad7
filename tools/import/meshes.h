// The meshes and materials of a world on its way into a scene, each of them once.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/import/material_rules.h"
#include "tools/import/materials.h"
#include "tools/import/report.h"
#include "tools/import/shape.h"
#include "tools/import/world.h"

namespace echoloop::worlds {

class Meshes {
  public:
    Meshes(World& world, Report& report, std::vector<MaterialRule>& rules)
        : world_(world), report_(report), rules_(rules) {}

    /// The mesh, in World::meshes, of a shape with the materials that its clues give it; nothing where rules
    /// leave all of it out. Of the same `key`, the same shape.
    std::optional<std::size_t> mesh_of(std::string key, const Shape& shape, Clues& clues);

  private:
    std::size_t material_index(const Material& material);

    World& world_;
    Report& report_;
    std::vector<MaterialRule>& rules_;
    std::map<std::string, std::size_t> meshes_;
};

}  // namespace echoloop::worlds
