#include "tools/import/shapes.h"

#include <sdf/sdf.hh>

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "tools/import/fault.h"
#include "tools/import/heightmap.h"
#include "tools/import/mesh_file.h"
#include "tools/import/primitives.h"

namespace echoloop::worlds {
namespace {

Vec3 vec(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

std::string exact(double value) {
    char out[32];
    std::snprintf(out, sizeof out, "%.17g", value);
    return out;
}
std::string exact(Vec3 v) { return exact(v.x) + " " + exact(v.y) + " " + exact(v.z); }

/// Of a heightmap, if its file says one.
std::optional<Vec3> size_of(const sdf::Heightmap& heightmap) {
    const auto element = heightmap.Element();
    if (element && !element->HasElement("size")) return std::nullopt;
    return vec(heightmap.Size());
}

}  // namespace

std::string key_of(const sdf::Geometry& geometry) {
    std::string out = std::to_string(static_cast<int>(geometry.Type()));
    const auto add = [&](const auto&... values) { ((out += " " + exact(values)), ...); };
    if (const auto* s = geometry.BoxShape()) add(vec(s->Size()));
    if (const auto* s = geometry.CylinderShape()) add(s->Radius(), s->Length());
    if (const auto* s = geometry.SphereShape()) add(s->Radius());
    if (const auto* s = geometry.CapsuleShape()) add(s->Radius(), s->Length());
    if (const auto* s = geometry.EllipsoidShape()) add(vec(s->Radii()));
    if (const auto* s = geometry.PlaneShape()) add(vec(s->Normal()), s->Size().X(), s->Size().Y());
    if (const auto* s = geometry.MeshShape())
        out += " " + s->Uri() + " " + s->Submesh() + " " + exact(vec(s->Scale())) +
               (s->CenterSubmesh() ? " c" : "");
    if (const auto* s = geometry.HeightmapShape())
        out += " " + s->Uri() + " " + (size_of(*s) ? exact(*size_of(*s)) : "own") + " " +
               exact(vec(s->Position()));
    return out;
}

const Shape& Shapes::get(const sdf::Geometry& geometry, const std::string& key) {
    const auto known = shapes_.find(key);
    return known != shapes_.end() ? known->second : shapes_.emplace(key, made(geometry)).first->second;
}

Shape Shapes::made(const sdf::Geometry& geometry) const {
    if (const auto* s = geometry.BoxShape()) return box(vec(s->Size()));
    if (const auto* s = geometry.CylinderShape()) return cylinder(s->Radius(), s->Length());
    if (const auto* s = geometry.SphereShape()) return ellipsoid({s->Radius(), s->Radius(), s->Radius()});
    if (const auto* s = geometry.CapsuleShape()) return capsule(s->Radius(), s->Length());
    if (const auto* s = geometry.EllipsoidShape()) return ellipsoid(vec(s->Radii()));
    if (const auto* s = geometry.PlaneShape()) return plane(vec(s->Normal()), s->Size().X(), s->Size().Y());
    if (const auto* s = geometry.MeshShape()) return mesh(*s);
    if (const auto* s = geometry.HeightmapShape())
        return read_heightmap(s->Uri(), size_of(*s), vec(s->Position()), notes_);
    return {};
}

Shape Shapes::mesh(const sdf::Mesh& mesh) const {
    const std::string& uri = mesh.Uri();
    if (uri.starts_with(drawn_address)) {
        const auto number = std::strtoul(uri.substr(std::string(drawn_address).size()).c_str(), nullptr, 10);
        if (number < sources_.drawn.size()) return sources_.drawn[number];
    }
    if (uri == "unit_box") return box(vec(mesh.Scale()));
    if (uri == "unit_sphere") return ellipsoid(0.5 * vec(mesh.Scale()));
    if (uri == "unit_cylinder") return cylinder(0.5 * mesh.Scale().X(), mesh.Scale().Z());
    return read_mesh(uri, {mesh.Submesh(), mesh.CenterSubmesh(), vec(mesh.Scale())}, paths_);
}

}  // namespace echoloop::worlds
