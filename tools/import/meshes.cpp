#include "tools/import/meshes.h"

#include <algorithm>
#include <utility>

namespace echoloop::worlds {

std::optional<std::size_t> Meshes::mesh_of(std::string key, const Shape& shape, Clues& clues) {
    std::vector<std::pair<const ShapeSurface*, std::size_t>> parts;
    for (const ShapeSurface& surface : shape) {
        clues.surface = surface.material;
        Choice choice = choose_material(clues, rules_);
        if (choice.leave_out) continue;
        const std::string label = choice.material.name;
        choice.material.double_sided = surface.double_sided;
        if (surface.double_sided) choice.material.name += " two-sided";
        parts.emplace_back(&surface, material_index(choice.material));
        key += " " + std::to_string(parts.back().second);
        report_.add({clues.model, label, choice.from, choice.guessed, parts.size() == 1 ? 1U : 0U,
                     surface.indices.size() / 3});
    }
    if (parts.empty()) return std::nullopt;
    if (const auto known = meshes_.find(key); known != meshes_.end()) return known->second;
    Mesh mesh{clues.mesh.empty() ? clues.visual : clues.mesh};
    for (const auto& [surface, material] : parts)
        mesh.surfaces.push_back({surface->positions, surface->indices, material});
    world_.meshes.push_back(std::move(mesh));
    return meshes_[key] = world_.meshes.size() - 1;
}

std::size_t Meshes::material_index(const Material& material) {
    const auto known = std::ranges::find(world_.materials, material);
    if (known != world_.materials.end()) return static_cast<std::size_t>(known - world_.materials.begin());
    world_.materials.push_back(material);
    return world_.materials.size() - 1;
}

}  // namespace echoloop::worlds
