#include "render/scene/document_parts.h"

#include <algorithm>

#include "render/scene/fault.h"
#include "render/scene/limits.h"

namespace echoloop {
namespace {

using Json = nlohmann::json;
using scene_limits::buffer_bytes;
using scene_limits::elements;

void copy_index(const JsonView& part, const char* key, std::size_t count, const char* what, Json& out) {
    if (const auto member = part.find(key)) out[key] = member->index(count, what);
}

void copy_integer(const JsonView& part, const char* key, std::uint64_t most, Json& out) {
    if (const auto member = part.find(key)) out[key] = member->integer(0, most);
}

void copy_name(const JsonView& part, Json& out) {
    if (const auto name = part.find("name")) out["name"] = name->text().substr(0, 256);
}

void copy_numbers(const JsonView& part, const char* key, std::size_t count, Json& out) {
    if (const auto member = part.find(key)) out[key] = member->numbers(count);
}

Json indices(const JsonView& part, const char* key, std::size_t count, const char* what) {
    Json out = Json::array();
    for (const auto& element : part.elements_of(key, elements)) out.push_back(element.index(count, what));
    return out;
}

Json check_primitive(const JsonView& primitive, const DocumentCounts& counts) {
    Json attributes = Json::object();
    const JsonView given = primitive.need("attributes");
    copy_index(given, "POSITION", counts.accessors, "accessors", attributes);
    copy_index(given, "NORMAL", counts.accessors, "accessors", attributes);
    if (!attributes.contains("POSITION"))
        scene_fault(given.place() + ".POSITION", "is missing", "export the mesh with positions");
    Json out = {{"attributes", attributes}};
    copy_index(primitive, "indices", counts.accessors, "accessors", out);
    copy_index(primitive, "material", counts.materials, "materials", out);
    copy_integer(primitive, "mode", 6, out);
    return out;
}

}  // namespace

Json check_each(const JsonView& root, const char* key, const DocumentCounts& counts, DocumentCheck check) {
    Json out = Json::array();
    for (const auto& part : root.elements_of(key, elements)) out.push_back(check(part, counts));
    return out;
}

Json check_buffer_view(const JsonView& view, const DocumentCounts& counts) {
    Json out = {{"buffer", view.need("buffer").index(counts.buffers, "buffers")},
                {"byteLength", view.need("byteLength").integer(1, buffer_bytes)}};
    copy_integer(view, "byteOffset", buffer_bytes, out);
    if (const auto stride = view.find("byteStride")) {
        out["byteStride"] = stride->integer(4, 252);
        if (stride->integer(4, 252) % 4 != 0)
            scene_fault(stride->place(), "must be a multiple of 4", "export the scene again as glTF 2.0");
    }
    return out;
}

Json check_accessor(const JsonView& accessor, const DocumentCounts& counts) {
    Json out = {{"componentType", accessor.need("componentType").integer(5120, 5126)},
                {"count", accessor.need("count").integer(1, buffer_bytes)},
                {"type", accessor.need("type").text().substr(0, 16)}};
    static const std::vector<std::string> types{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    if (std::find(types.begin(), types.end(), out["type"].get<std::string>()) == types.end())
        scene_fault(accessor.place() + ".type", "is not a glTF type", "export the scene again as glTF 2.0");
    copy_index(accessor, "bufferView", counts.views, "bufferViews", out);
    copy_integer(accessor, "byteOffset", buffer_bytes, out);
    if (const auto normalized = accessor.find("normalized")) out["normalized"] = normalized->boolean();
    return out;
}

Json check_material(const JsonView& material, const DocumentCounts&) {
    Json out = Json::object();
    copy_name(material, out);
    return out;
}

Json check_mesh(const JsonView& mesh, const DocumentCounts& counts) {
    Json out = {{"primitives", Json::array()}};
    copy_name(mesh, out);
    for (const auto& primitive : mesh.need("primitives").elements(elements))
        out["primitives"].push_back(check_primitive(primitive, counts));
    return out;
}

Json check_node(const JsonView& node, const DocumentCounts& counts) {
    Json out = Json::object();
    copy_name(node, out);
    copy_index(node, "mesh", counts.meshes, "meshes", out);
    if (node.find("children")) out["children"] = indices(node, "children", counts.nodes, "nodes");
    copy_numbers(node, "matrix", 16, out);
    copy_numbers(node, "translation", 3, out);
    copy_numbers(node, "rotation", 4, out);
    copy_numbers(node, "scale", 3, out);
    return out;
}

Json check_scene(const JsonView& scene, const DocumentCounts& counts) {
    return {{"nodes", indices(scene, "nodes", counts.nodes, "nodes")}};
}

}  // namespace echoloop
