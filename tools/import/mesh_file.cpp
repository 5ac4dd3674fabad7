#include "tools/import/mesh_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "render/scene/limits.h"
#include "tools/import/fault.h"

namespace echoloop::worlds {
namespace fs = std::filesystem;
namespace {

const std::set<std::string> kinds{".dae", ".obj", ".stl", ".ply", ".gltf", ".glb"};

/// What assimp may open.
class Files : public Assimp::DefaultIOSystem {
  public:
    explicit Files(const ModelPaths& paths) : paths_(paths) {}
    bool Exists(const char* file) const override { return may_open(file); }
    Assimp::IOStream* Open(const char* file, const char* mode) override {
        return mode[0] == 'r' && may_open(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
    }

  private:
    bool may_open(const char* file) const {
        std::error_code ec;
        return fs::is_regular_file(file, ec) && paths_.holds(file);
    }
    const ModelPaths& paths_;
};

void prepare(Assimp::Importer& importer, const ModelPaths& paths) {
    importer.SetIOHandler(new Files(paths));  // which it deletes
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                                aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                    aiComponent_COLORS | aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
                                    aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                                    aiComponent_CAMERAS);
}

class Gatherer {
  public:
    Gatherer(const aiScene& scene, const std::string& submesh) : scene_(scene), submesh_(submesh) {}

    void visit(const aiNode& node, const aiMatrix4x4& above, int depth) {
        if (depth > 500) throw std::runtime_error("its nodes are nested deeper than 500");
        const aiMatrix4x4 here = above * node.mTransformation;
        for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene_.mMeshes[node.mMeshes[i]], node, here);
        for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], here, depth + 1);
    }

    Shape shape;

  private:
    void add(const aiMesh& mesh, const aiNode& node, const aiMatrix4x4& here) {
        if (!submesh_.empty() && submesh_ != node.mName.C_Str() && submesh_ != mesh.mName.C_Str()) return;
        ShapeSurface& surface = surface_of(mesh);
        const auto first = static_cast<std::uint32_t>(surface.positions.size());
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            const aiVector3D p = here * mesh.mVertices[i];
            surface.positions.push_back({p.x, p.y, p.z});
        }
        const bool mirrored = here.Determinant() < 0;
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
            const aiFace& face = mesh.mFaces[i];
            if (face.mNumIndices != 3) continue;
            for (const unsigned k : {0U, mirrored ? 2U : 1U, mirrored ? 1U : 2U}) {
                if (face.mIndices[k] >= mesh.mNumVertices)
                    throw std::runtime_error("an index is out of range");
                surface.indices.push_back(first + face.mIndices[k]);
            }
        }
    }

    ShapeSurface& surface_of(const aiMesh& mesh) {
        aiString name;
        if (mesh.mMaterialIndex < scene_.mNumMaterials)
            scene_.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, name);
        const std::string text = printable(name.C_Str());
        const auto known = std::ranges::find(shape, text, &ShapeSurface::material);
        if (known != shape.end()) return *known;
        shape.push_back({{}, {}, text, false});
        return shape.back();
    }

    const aiScene& scene_;
    const std::string& submesh_;
};

void center(Shape& shape) {
    Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (const ShapeSurface& surface : shape)
        for (const Vec3& p : surface.positions) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    for (ShapeSurface& surface : shape)
        for (Vec3& p : surface.positions) p = p - 0.5 * (low + high);
}

void scale(ShapeSurface& surface, Vec3 by) {
    for (Vec3& p : surface.positions) {
        p = {p.x * by.x, p.y * by.y, p.z * by.z};
        if (!std::isfinite(p.x + p.y + p.z)) throw std::runtime_error("a position is not finite");
        if (!(std::abs(p.x) <= scene_limits::extent && std::abs(p.y) <= scene_limits::extent &&
              std::abs(p.z) <= scene_limits::extent))
            throw std::runtime_error("a position is beyond 100 km (are its units metres?)");
    }
    if (by.x * by.y * by.z < 0)
        for (std::size_t i = 0; i < surface.indices.size(); i += 3)
            std::swap(surface.indices[i + 1], surface.indices[i + 2]);
}

/// assimp believes the counts of a .ply, however small the file is.
void check_counts(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const auto size = static_cast<double>(fs::file_size(file));
    std::string line;
    for (int i = 0; i < 1000 && std::getline(in, line) && !line.starts_with("end_header"); ++i) {
        std::istringstream words(line);
        std::string word, name;
        double count = 0;
        if (words >> word >> name >> count && word == "element" && !(count >= 0 && count <= size))
            throw std::runtime_error("it says that it holds more than its bytes can");
    }
}

}  // namespace

Shape read_mesh(const fs::path& file, const MeshChoice& choice, const ModelPaths& paths) {
    const std::string kind = lower_case(file.extension());
    if (!kinds.contains(kind))
        throw Fault(printable(file.string()), "is a kind of mesh that is not read",
                    "export it as .dae, .obj, .stl, .ply, .gltf or .glb");
    try {
        if (kind == ".ply") check_counts(file);
        Assimp::Importer importer;
        prepare(importer, paths);
        const aiScene* scene = importer.ReadFile(
            file, aiProcess_ValidateDataStructure | aiProcess_RemoveComponent | aiProcess_Triangulate |
                      aiProcess_SortByPType | aiProcess_JoinIdenticalVertices);
        if (scene == nullptr || scene->mRootNode == nullptr)
            throw Fault(printable(file.string()), "cannot be read: " + printable(importer.GetErrorString()),
                        "export the mesh again");
        Gatherer gatherer(*scene, choice.submesh);
        gatherer.visit(*scene->mRootNode, aiMatrix4x4(), 0);
        Shape shape = std::move(gatherer.shape);
        if (triangles_of(shape) == 0)
            throw std::runtime_error(choice.submesh.empty() ? "it holds no triangles"
                                                            : "it has no part of the name \"" +
                                                                  printable(choice.submesh) + "\"");
        if (choice.center) center(shape);
        for (ShapeSurface& surface : shape) scale(surface, choice.scale), settle_sides(surface);
        return shape;
    } catch (const Fault&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Fault(printable(file.string()), error.what(), "export the mesh again");
    }
}

}  // namespace echoloop::worlds
