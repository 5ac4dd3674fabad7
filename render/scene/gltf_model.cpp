#include "render/scene/gltf_model.h"

#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <span>

#include "render/scene/fault.h"
#include "render/scene/mesh_loops.h"

namespace echoloop {
namespace {

/// From 2.9 on tinygltf asks for sizes, too, and opens nothing if it cannot.
template <typename Callbacks>
void tell_sizes(Callbacks& fs) {
    if constexpr (requires { fs.GetFileSizeInBytes; })
        fs.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void*) {
            *size = 1;
            return true;
        };
}

/// tinygltf's view of the file system: files of one byte. The document has their contents, which need no
/// copy.
tinygltf::FsCallbacks only_names() {
    tinygltf::FsCallbacks fs{};
    fs.FileExists = [](const std::string&, void*) { return true; };
    fs.ExpandFilePath = [](const std::string& path, void*) { return path; };
    fs.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string&, void*) {
        out->assign(1, 0);
        return true;
    };
    fs.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
        return false;
    };
    tell_sizes(fs);
    return fs;
}

bool no_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
              void*) {
    return true;
}

tinygltf::Model parse(const SceneDocument& document) {
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(only_names());
    loader.SetImageLoader(no_image, nullptr);
    tinygltf::Model model;
    std::string errors, warnings;
    bool good = false;
    try {
        good = loader.LoadASCIIFromString(&model, &errors, &warnings, document.json.data(),
                                          static_cast<unsigned>(document.json.size()), "");
    } catch (const std::exception& error) {
        errors = error.what();
    }
    if (good) return model;
    for (char& c : errors)
        if (c == '\n') c = ' ';
    scene_fault("", "tinygltf says: " + errors, export_again);
}

std::optional<std::size_t> optional_index(int index) {
    return index < 0 ? std::nullopt : std::optional<std::size_t>(static_cast<std::size_t>(index));
}

}  // namespace

struct GltfModel::Parsed {
    tinygltf::Model model;
};

/// Where the elements of an accessor lie, already checked against the buffer.
struct GltfModel::Elements {
    const unsigned char* first;
    std::size_t count, stride;
    int component;
};

GltfModel::GltfModel(const SceneDocument& document)
    : parsed_(std::make_unique<Parsed>(Parsed{parse(document)})), document_(document) {
    copy_nodes();
    copy_meshes();
}

GltfModel::~GltfModel() = default;

void GltfModel::copy_nodes() {
    const auto& model = parsed_->model;
    std::vector<bool> child(model.nodes.size());
    for (const auto& node : model.nodes) {
        GltfNode copy{node.name, optional_index(node.mesh), {}, node.matrix, node.translation, node.rotation,
                      node.scale};
        for (const int index : node.children) {
            copy.children.push_back(static_cast<std::size_t>(index));
            child.at(static_cast<std::size_t>(index)) = true;
        }
        nodes_.push_back(std::move(copy));
    }
    if (model.scenes.empty()) {
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (!child[i]) roots_.push_back(i);
        return;
    }
    for (const int root : model.scenes.at(static_cast<std::size_t>(std::max(0, model.defaultScene))).nodes)
        roots_.push_back(static_cast<std::size_t>(root));
}

void GltfModel::copy_meshes() {
    const auto& meshes = parsed_->model.meshes;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        meshes_.emplace_back();
        for (std::size_t p = 0; p < meshes[m].primitives.size(); ++p) {
            const auto& primitive = meshes[m].primitives[p];
            GltfPrimitive copy;
            copy.place = "meshes[" + std::to_string(m) + "].primitives[" + std::to_string(p) + "]";
            copy.mode = primitive.mode < 0 ? 4 : primitive.mode;
            copy.positions = static_cast<std::size_t>(primitive.attributes.at("POSITION"));
            const auto normal = primitive.attributes.find("NORMAL");
            if (normal != primitive.attributes.end()) copy.normals = optional_index(normal->second);
            copy.indices = optional_index(primitive.indices);
            copy.material = optional_index(primitive.material);
            meshes_.back().push_back(std::move(copy));
        }
    }
}

GltfModel::Elements GltfModel::elements(std::size_t index, const std::string& place) const {
    const auto& model = parsed_->model;
    const auto& accessor = model.accessors.at(index);
    const std::string name = "accessors[" + std::to_string(index) + "]";
    if (document_.sparse[index])
        scene_fault(place, name + " is sparse, which is not supported", "export without sparse accessors");
    if (accessor.bufferView < 0) scene_fault(place, name + " has no bufferView", export_again);
    const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
    const auto buffer = static_cast<std::size_t>(view.buffer);
    std::span<const unsigned char> data = document_.buffers.at(buffer);
    if (data.empty()) data = model.buffers.at(buffer).data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        scene_fault("bufferViews[" + std::to_string(accessor.bufferView) + "]", "reaches beyond its buffer",
                    export_again);
    const auto component = static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
    const std::size_t size =
        component *
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
    const std::size_t stride = view.byteStride == 0 ? size : view.byteStride;
    if (stride < size) scene_fault(place, name + " has elements larger than their byteStride", export_again);
    const std::size_t room = view.byteLength - std::min(view.byteLength, accessor.byteOffset);
    if (room < size || accessor.count - 1 > (room - size) / stride)
        scene_fault(place, name + " reaches beyond its bufferView", export_again);
    return {data.data() + view.byteOffset + accessor.byteOffset, accessor.count, stride,
            accessor.componentType};
}

std::vector<Vec3> GltfModel::read_vectors(std::size_t index, const std::string& place) const {
    const auto& accessor = parsed_->model.accessors.at(index);
    if (accessor.type != TINYGLTF_TYPE_VEC3 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        scene_fault(place, "must be VEC3 of float", "export the scene without quantisation");
    const Elements source = elements(index, place);
    std::vector<Vec3> out(source.count);
    const auto is_finite = [](const Vec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    const bool bad = MeshLoops(source.count).any(source.count, [&](std::size_t i) {
        float xyz[3];
        std::memcpy(xyz, source.first + i * source.stride, sizeof xyz);
        out[i] = {xyz[0], xyz[1], xyz[2]};
        return !is_finite(out[i]);
    });
    for (std::size_t i = 0; bad && i < source.count; ++i)
        if (!is_finite(out[i]))
            scene_fault(place, "element " + std::to_string(i) + " is not finite", "repair the mesh");
    return out;
}

std::vector<std::array<float, 4>> GltfModel::read_values(std::size_t index, std::size_t parts,
                                                         const std::string& place) const {
    const auto& accessor = parsed_->model.accessors.at(index);
    const int type = parts == 1 ? TINYGLTF_TYPE_SCALAR : parts == 3 ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_VEC4;
    if (accessor.type != type || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        scene_fault(place,
                    "must be " +
                        std::string(parts == 1   ? "SCALAR"
                                    : parts == 3 ? "VEC3"
                                                 : "VEC4") +
                        " of float",
                    "export the scene without quantisation");
    const Elements source = elements(index, place);
    std::vector<std::array<float, 4>> out(source.count);
    for (std::size_t i = 0; i < source.count; ++i) {
        std::memcpy(out[i].data(), source.first + i * source.stride, parts * sizeof(float));
        for (const float part : out[i])
            if (!std::isfinite(part))
                scene_fault(place, "element " + std::to_string(i) + " is not finite",
                            "export the scene again");
    }
    return out;
}

std::vector<float> GltfModel::read_scalars(std::size_t index, const std::string& place) const {
    std::vector<float> out;
    for (const auto& value : read_values(index, 1, place)) out.push_back(value[0]);
    return out;
}

std::vector<std::uint32_t> GltfModel::read_indices(std::size_t index, std::size_t count,
                                                   const std::string& place) const {
    const auto& accessor = parsed_->model.accessors.at(index);
    const int kind = accessor.componentType;
    const std::size_t size = kind == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 1
                             : kind == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2
                             : kind == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT   ? 4
                                                                              : 0;
    if (accessor.type != TINYGLTF_TYPE_SCALAR || size == 0)
        scene_fault(place, "must be SCALAR of an unsigned type", export_again);
    const Elements source = elements(index, place);
    std::vector<std::uint32_t> out(source.count);
    const bool bad = MeshLoops(source.count / 3).any(source.count, [&](std::size_t i) {
        std::memcpy(&out[i], source.first + i * source.stride,
                    size);  // little-endian, as glTF and the host are
        return out[i] >= count;
    });
    for (std::size_t i = 0; bad && i < source.count; ++i)
        if (out[i] >= count)
            scene_fault(place,
                        "index " + std::to_string(out[i]) + " at " + std::to_string(i) +
                            " is not below the " + std::to_string(count) + " vertices",
                        "repair the mesh");
    return out;
}

}  // namespace echoloop
