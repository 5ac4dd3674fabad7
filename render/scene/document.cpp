#include "render/scene/document.h"

#include "render/scene/document_parts.h"
#include "render/scene/fault.h"
#include "render/scene/json_view.h"
#include "render/scene/limits.h"

namespace echoloop {
namespace {

using Json = nlohmann::json;
using scene_limits::elements;

Json parse(std::string_view text) {
    if (text.empty()) scene_fault("", "the file is empty", "export the scene again as glTF 2.0");
    check_json_shape(text);
    try {
        return Json::parse(text);
    } catch (const Json::exception& error) {
        scene_fault("", std::string("not valid JSON: ") + error.what(), "export the scene again as glTF 2.0");
    }
}

void check_asset(const JsonView& root) {
    if (!root.value().is_object()) scene_fault("", "the file is not a glTF object", "export it as glTF 2.0");
    const auto asset = root.find("asset");
    const auto version = asset ? asset->find("version") : std::nullopt;
    if (!version || version->text().rfind("2.", 0) != 0)
        scene_fault("asset.version", "is not 2.0", "export the scene as glTF 2.0");
}

/// What changes only colours may be required; what changes geometry may not, as it would be ignored here.
void check_extensions(const JsonView& root) {
    for (const auto& extension : root.elements_of("extensionsRequired", 1000)) {
        const std::string& name = extension.text();
        if (name.rfind("KHR_materials_", 0) == 0 || name.rfind("KHR_texture_", 0) == 0 ||
            name.rfind("EXT_texture_", 0) == 0 || name == "KHR_lights_punctual")
            continue;
        scene_fault(extension.place(), "extension " + name + " is not supported",
                    "export the scene without it (no mesh compression, no quantisation)");
    }
}

std::span<const unsigned char> buffer_contents(const JsonView& buffer, std::size_t size, std::size_t index,
                                               const SceneContainer& container, const SceneFolder& folder,
                                               std::vector<SceneFolder::Bytes>& files) {
    if (const auto uri = buffer.find("uri")) {
        files.push_back(folder.read(uri->text(), size, uri->place()));
        return files.back();
    }
    if (index != 0 || !container.has_binary)
        scene_fault(buffer.place(), "has no uri, and the file has no binary chunk for it",
                    "export the scene again");
    if (container.binary.size() < size)
        scene_fault(buffer.place() + ".byteLength", "is larger than the binary chunk",
                    "export the scene again");
    return container.binary.first(size);
}

Json check_buffers(const JsonView& root, const SceneContainer& container, const SceneFolder& folder,
                   SceneDocument& out) {
    Json clean = Json::array();
    std::size_t total = 0;
    for (const auto& buffer : root.elements_of("buffers", 256)) {
        const auto length = buffer.find("byteLength");
        if (!length) scene_fault(buffer.place() + ".byteLength", "is missing", "export the scene again");
        const std::size_t size = length->integer(1, scene_limits::buffer_bytes - total);
        total += size;
        const auto uri = buffer.find("uri");
        const bool embedded = uri && uri->text().rfind("data:", 0) == 0;
        const std::size_t index = out.buffers.size();
        out.buffers.push_back(embedded ? std::span<const unsigned char>{}
                                       : buffer_contents(buffer, size, index, container, folder, out.files));
        clean.push_back(
            {{"byteLength", embedded ? size : 1}, {"uri", embedded ? uri->text() : buffer_uri(index)}});
    }
    return clean;
}

}  // namespace

std::string buffer_uri(std::size_t index) { return "buffer" + std::to_string(index); }

SceneDocument check_document(const SceneContainer& container, const SceneFolder& folder, bool animations) {
    const Json parsed = parse(container.json);
    const JsonView root(parsed, "");
    check_asset(root);
    check_extensions(root);
    const DocumentCounts counts{
        root.elements_of("buffers", 256).size(),        root.elements_of("bufferViews", elements).size(),
        root.elements_of("accessors", elements).size(), root.elements_of("materials", elements).size(),
        root.elements_of("meshes", elements).size(),    root.elements_of("nodes", elements).size(),
        root.elements_of("scenes", elements).size()};
    SceneDocument out;
    Json clean = {{"asset", {{"version", "2.0"}}}};
    clean["buffers"] = check_buffers(root, container, folder, out);
    clean["bufferViews"] = check_each(root, "bufferViews", counts, check_buffer_view);
    clean["accessors"] = check_each(root, "accessors", counts, check_accessor);
    clean["materials"] = check_each(root, "materials", counts, check_material);
    clean["meshes"] = check_each(root, "meshes", counts, check_mesh);
    clean["nodes"] = check_each(root, "nodes", counts, check_node);
    clean["scenes"] = check_each(root, "scenes", counts, check_scene);
    if (const auto scene = root.find("scene")) clean["scene"] = scene->index(counts.scenes, "scenes");
    if (const auto scenes = root.elements_of("scenes", elements); !scenes.empty())
        out.origin = read_origin(scenes[clean.value("scene", std::size_t{0})]);
    for (const auto& material : root.elements_of("materials", elements))
        out.materials.push_back(read_material(material));
    for (const auto& node : root.elements_of("nodes", elements))
        out.target_strengths.push_back(read_target_strength(node));
    for (const auto& accessor : root.elements_of("accessors", elements))
        out.sparse.push_back(accessor.find("sparse").has_value());
    if (animations) out.channels = read_channels(root, counts, out.channels_left_out);
    out.json = clean.dump(-1, ' ', false, Json::error_handler_t::replace);
    return out;
}

}  // namespace echoloop
