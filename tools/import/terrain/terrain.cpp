#include "tools/import/terrain/terrain.h"

#include <algorithm>
#include <cstdio>

#include "tools/import/fault.h"
#include "tools/import/terrain/placing.h"
#include "tools/import/terrain/triangulation.h"

namespace echoloop::worlds {
namespace {

std::optional<GeoPlace> origin_of(const World& world, const TerrainOptions& options) {
    const auto& origin = world.origin ? world.origin : options.origin;
    if (!origin) return {};
    return GeoPlace{origin->latitude, origin->longitude, origin->height};
}

template <class... Values>
std::string text(const char* format, Values... values) {
    char out[200];
    std::snprintf(out, sizeof out, format, values...);
    return out;
}

Triangulation simplify(const std::filesystem::path& file, Heights& heights, const Placing& placing,
                       const TerrainOptions& options) {
    const TriangulationRules rules{options.error, options.triangles, placing.lattice(options.error / 4),
                                   options.told};
    Triangulation out = triangulate(heights, rules);
    if (out.triangles.empty() && out.needed <= options.triangles)
        throw Fault(file, "has no four neighbouring samples that all have a value",
                    "fill small holes with gdal_fillnodata.py");
    if (out.triangles.empty())
        throw Fault(file,
                    "needs " + std::to_string(out.needed) + " triangles for the edges of its holes" +
                        (rules.lattice > 0 ? " and the curvature of the Earth" : "") + " alone",
                    "raise --triangles, or fill small holes with gdal_fillnodata.py");
    return out;
}

/// Degrees that are taken for metres make a bottom of a few millimetres.
void refuse_specks(const std::filesystem::path& file, const std::vector<Vec3>& positions) {
    const auto [west, east] = std::ranges::minmax(positions, {}, &Vec3::x);
    const auto [south, north] = std::ranges::minmax(positions, {}, &Vec3::y);
    if (std::max(east.x - west.x, north.y - south.y) >= 0.1) return;
    throw Fault(file, text("is %.3g m wide", east.x - west.x),
                "if its coordinates are degrees, say so with --crs EPSG:4326");
}

/// Seen from above counter-clockwise, whichever way the rows go.
Surface surface_of(const Triangulation& mesh, std::vector<Vec3> positions) {
    Surface out;
    const auto& [a, b, c] = mesh.triangles.front();
    const Vec3 up = cross(positions[b] - positions[a], positions[c] - positions[a]);
    for (const auto& corners : mesh.triangles) {
        out.indices.insert(out.indices.end(), corners.begin(), corners.end());
        if (up.z < 0) std::swap(out.indices[out.indices.size() - 1], out.indices[out.indices.size() - 2]);
    }
    out.positions = std::move(positions);
    return out;
}

Material material_of(const std::string& name) {
    const bool is_seabed = name.find('-') != std::string::npos;
    return {.name = name, .acoustic = is_seabed ? "" : name, .seabed = is_seabed ? name : ""};
}

}  // namespace

std::vector<std::string> add_terrain(World& world, const std::filesystem::path& file,
                                     const TerrainOptions& options) {
    Survey survey = read_survey(file, options.survey);
    const Placing placing(file, survey, origin_of(world, options));
    const Triangulation mesh = simplify(file, survey.heights, placing, options);
    auto positions = placing.place(survey.heights, mesh.corners);
    refuse_specks(file, positions);
    Surface surface = surface_of(mesh, std::move(positions));

    auto notes = std::move(survey.notes);
    if (mesh.lone > 0)
        notes.push_back(std::to_string(mesh.lone) +
                        " samples are left out, since they have no neighbours to make a surface with");
    if (const auto& origin = placing.origin())
        notes.push_back(
            text("the world's origin is at latitude %.7f, longitude %.7f", origin->latitude,
                 origin->longitude) +
            (origin_of(world, options) ? "" : ", the middle of the grid (--origin puts it elsewhere)"));
    const auto [low, high] = std::ranges::minmax(surface.positions, {}, &Vec3::z);
    notes.push_back(text("z is from %.2f to %.2f m", low.z, high.z));
    notes.push_back(text("%zu triangles are at most %.3g m above or below each sample", mesh.triangles.size(),
                         mesh.error));
    if (mesh.error > options.error)
        notes.push_back(text("they ran out (--triangles %zu) before the error was --error %g m",
                             options.triangles, options.error));

    surface.material = world.materials.size();
    world.materials.push_back(material_of(options.material));
    world.meshes.push_back({file.stem().string(), {std::move(surface)}});
    world.nodes.push_back({.name = file.stem().string(), .mesh = world.meshes.size() - 1});
    world.roots.push_back(world.nodes.size() - 1);
    if (const auto& origin = placing.origin())
        world.origin = Origin{origin->latitude, origin->longitude, origin->height};
    return notes;
}

}  // namespace echoloop::worlds
