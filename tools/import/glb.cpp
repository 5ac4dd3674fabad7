#include "tools/import/glb.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <ostream>
#include <stdexcept>

#include "render/scene/limits.h"

namespace echoloop::worlds {
namespace {

using Json = nlohmann::ordered_json;
using Float3 = std::array<float, 3>;

Float3 gltf_from_enu(Vec3 p) {
    return {static_cast<float>(p.x), static_cast<float>(p.z), static_cast<float>(-p.y)};
}

Json triple(Float3 p) { return {double{p[0]}, double{p[1]}, double{p[2]}}; }

void write_bytes(std::ostream& out, const void* data, std::size_t size) {
    out.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

void write_word(std::ostream& out, std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    const std::array<unsigned char, 4> bytes{
        static_cast<unsigned char>(word), static_cast<unsigned char>(word >> 8U),
        static_cast<unsigned char>(word >> 16U), static_cast<unsigned char>(word >> 24U)};
    write_bytes(out, bytes.data(), bytes.size());
}

/// The document; the bytes of its one buffer are written afterwards, surface by surface, in the same order.
class Document {
  public:
    explicit Document(const World& world) : world_(world) {
        json_ = {{"asset", {{"version", "2.0"}, {"generator", "echoloop import"}}}, {"scene", 0}};
        add_scene();
        add_meshes();
        for (const Node& node : world.nodes) json_["nodes"].push_back(node_json(node));
        if (world.nodes.empty()) throw std::runtime_error("the world holds nothing");
        for (const Material& material : world.materials)
            json_["materials"].push_back(material_json(material));
        if (size_ > 0) json_["buffers"] = Json::array({{{"byteLength", size_}}});
        if (size_ > scene_limits::buffer_bytes)
            throw std::runtime_error("the meshes take more than 1 GiB; simplify them");
    }

    std::string text() const { return json_.dump(-1, ' ', false, Json::error_handler_t::replace); }
    std::size_t size() const { return size_; }

  private:
    void add_scene() {
        Json scene = {{"nodes", world_.roots}};
        if (world_.origin)
            scene["extras"] = {{"origin",
                                {{"latitude", world_.origin->latitude},
                                 {"longitude", world_.origin->longitude},
                                 {"height", world_.origin->height}}}};
        json_["scenes"] = Json::array({scene});
    }

    Json node_json(const Node& node) const {
        Json out = {{"name", node.name}};
        const Vec3 p = node.pose.position;
        const Quat q = node.pose.orientation;
        if (!std::isfinite(p.x + p.y + p.z + q.w + q.x + q.y + q.z))
            throw std::runtime_error("the pose of \"" + node.name + "\" is not finite");
        if (p != Vec3{}) out["translation"] = {p.x, p.z, -p.y + 0.0};
        if (q != Quat{}) out["rotation"] = {q.x, q.z, -q.y + 0.0, q.w};
        if (node.mesh && index_of_.at(*node.mesh)) out["mesh"] = *index_of_[*node.mesh];
        if (!node.children.empty()) out["children"] = node.children;
        return out;
    }

    static bool is_empty(const Mesh& mesh) {
        return std::ranges::all_of(mesh.surfaces, [](const Surface& s) { return s.indices.empty(); });
    }

    void add_meshes() {
        for (const Mesh& mesh : world_.meshes) {
            index_of_.emplace_back();
            if (is_empty(mesh)) continue;
            Json primitives = Json::array();
            for (const Surface& surface : mesh.surfaces)
                if (!surface.indices.empty()) primitives.push_back(primitive_json(mesh, surface));
            json_["meshes"].push_back({{"name", mesh.name}, {"primitives", primitives}});
            index_of_.back() = json_["meshes"].size() - 1;
        }
    }

    Json primitive_json(const Mesh& mesh, const Surface& surface) {
        check(mesh, surface);
        Float3 low{}, high{};
        low.fill(std::numeric_limits<float>::infinity());
        high.fill(-low[0]);
        for (const Vec3& position : surface.positions) {
            const Float3 p = gltf_from_enu(position);
            for (std::size_t k = 0; k < 3; ++k)
                low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
        }
        constexpr int float_type = 5126, unsigned_type = 5125;
        const Json positions = {{"bufferView", view(12 * surface.positions.size())},
                                {"componentType", float_type},
                                {"count", surface.positions.size()},
                                {"type", "VEC3"},
                                {"min", triple(low)},
                                {"max", triple(high)}};
        const Json indices = {{"bufferView", view(4 * surface.indices.size())},
                              {"componentType", unsigned_type},
                              {"count", surface.indices.size()},
                              {"type", "SCALAR"}};
        json_["accessors"].push_back(positions);
        json_["accessors"].push_back(indices);
        const std::size_t count = json_["accessors"].size();
        return {{"attributes", {{"POSITION", count - 2}}},
                {"indices", count - 1},
                {"material", surface.material}};
    }

    void check(const Mesh& mesh, const Surface& surface) const {
        const auto refuse = [&](const std::string& why) {
            throw std::runtime_error("mesh \"" + mesh.name + "\" " + why);
        };
        constexpr double most = scene_limits::extent;
        for (const Vec3& p : surface.positions)
            if (!(std::abs(p.x) <= most && std::abs(p.y) <= most && std::abs(p.z) <= most))
                refuse("has a vertex that is not finite or beyond 100 km; are its units metres?");
        for (const std::uint32_t index : surface.indices)
            if (index >= surface.positions.size()) refuse("has an index out of range");
        if (surface.indices.size() % 3 != 0) refuse("has indices that are no triangles");
        if (surface.material >= world_.materials.size()) refuse("has a material that is not there");
    }

    std::size_t view(std::size_t bytes) {
        json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", size_}, {"byteLength", bytes}});
        size_ += bytes;
        return json_["bufferViews"].size() - 1;
    }

    static Json material_json(const Material& material) {
        Json out = {{"name", material.name}};
        if (material.double_sided) out["doubleSided"] = true;
        Json sonar = Json::object();
        if (!material.acoustic.empty()) sonar["material"] = material.acoustic;
        if (!material.seabed.empty()) sonar["seabed"] = material.seabed;
        for (const auto& [key, value] : material.figures) sonar[key] = value;
        if (!sonar.empty()) out["extras"] = {{"sonar", sonar}};
        return out;
    }

    const World& world_;
    Json json_;
    std::vector<std::optional<std::size_t>> index_of_;  ///< meshes in the file, where empty ones are not
    std::size_t size_ = 0;
};

void write_surface(const Surface& surface, std::ostream& out) {
    std::vector<Float3> positions(surface.positions.size());
    std::ranges::transform(surface.positions, positions.begin(), gltf_from_enu);
    write_bytes(out, positions.data(), sizeof(Float3) * positions.size());
    write_bytes(out, surface.indices.data(), sizeof(std::uint32_t) * surface.indices.size());
}

}  // namespace

void write_glb(const World& world, std::ostream& out) {
    const Document document(world);
    std::string text = document.text();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t binary = document.size() > 0 ? 8 + document.size() : 0;
    constexpr std::uint32_t magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
    write_word(out, magic);
    write_word(out, 2);
    write_word(out, 12 + 8 + text.size() + binary);
    write_word(out, text.size());
    write_word(out, json_chunk);
    write_bytes(out, text.data(), text.size());
    if (binary == 0) return;
    write_word(out, document.size());
    write_word(out, binary_chunk);
    for (const Mesh& mesh : world.meshes)
        for (const Surface& surface : mesh.surfaces)
            if (!surface.indices.empty()) write_surface(surface, out);
}

void write_glb(const World& world, const std::filesystem::path& file) {
    std::ofstream out(file, std::ios::binary);
    write_glb(world, out);
    if (!out.flush()) throw std::runtime_error("cannot write all of it; is the disk full?");
}

}  // namespace echoloop::worlds
