#include "tools/view/scene_message.h"

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

namespace echoloop::view {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_triangles = 200'000;  // own choice: 7 MB

struct Piece {
    const SceneNode* node;
    std::uint32_t mover;  ///< 0: none
};

std::uint32_t mover_of(const Scene& scene, std::size_t node) {
    const auto movers = scene.movers();
    for (std::size_t i = 0; i < movers.size(); ++i)
        if (node >= movers[i].first_node && node < movers[i].last_node)
            return static_cast<std::uint32_t>(i) + 1;
    return 0;
}

/// What is drawn where stand-ins may be off by `error` m.
std::vector<Piece> cut_at(const Scene& scene, float error) {
    std::vector<Piece> pieces;
    const auto nodes = scene.nodes();
    for (std::size_t i = 0; i < nodes.size();) {
        const SceneNode& node = nodes[i];
        const bool leaf = node.next == i + 1;
        if ((node.coarse && node.error <= error) || (leaf && !node.coarse)) {
            pieces.push_back({&node, mover_of(scene, i)});
            i = node.next;
        } else {
            ++i;
        }
    }
    return pieces;
}

std::size_t triangles_of(const std::vector<Piece>& pieces) {
    std::size_t sum = 0;
    for (const Piece& piece : pieces) sum += piece.node->indices / 3;
    return sum;
}

}  // namespace

std::string scene_message(const Scene& scene, const std::string& name) {
    float error = 0;
    std::vector<Piece> pieces = cut_at(scene, error);
    while (triangles_of(pieces) > most_triangles && error < 1000) {
        error = error > 0 ? 2 * error : 0.05F;
        pieces = cut_at(scene, error);
    }
    std::map<std::uint32_t, std::string> by_mover;
    for (const Piece& piece : pieces) {
        std::string& corners = by_mover[piece.mover];
        const SceneNode& node = *piece.node;
        const auto indices =
            (node.coarse ? scene.coarse_indices() : scene.indices()).subspan(node.first_index, node.indices);
        const auto vertices =
            (node.coarse ? scene.coarse_vertices() : scene.vertices()).subspan(node.first_vertex);
        for (const std::uint16_t index : indices) {
            char bytes[sizeof vertices[index].position];
            std::memcpy(bytes, vertices[index].position.data(), sizeof bytes);
            corners.append(bytes, sizeof bytes);
        }
    }
    const Bounds& bounds = scene.bounds();
    Json head{{"type", "scene"},
              {"name", name},
              {"objects", scene.objects()},
              {"triangles", scene.triangles()},
              {"error", error}};
    head["bounds"] = {bounds.min, bounds.max};
    head["parts"] = Json::array();
    std::string floats;
    for (const auto& [mover, corners] : by_mover) {
        head["parts"].push_back({{"mover", mover}, {"corners", corners.size() / (3 * sizeof(float))}});
        floats += corners;
    }
    const std::string text = head.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string message;
    for (int i = 0; i < 4; ++i) message += static_cast<char>(text.size() >> (8 * i) & 0xFF);
    return message + text + floats;
}

}  // namespace echoloop::view
