#include "render/gl/split_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/gl/culling.h"

namespace echoloop::gl {
namespace {

constexpr std::size_t patch_triangles = 24;
constexpr int deepest = 24;    ///< halvings
constexpr double lattice = 4;  ///< m, of places from where scenes are split

Vec3 place_of(const SceneVertex& vertex) {
    return {vertex.position[0], vertex.position[1], vertex.position[2]};
}

SceneVertex middle_of(const SceneVertex& a, const SceneVertex& b) {
    SceneVertex middle = a;
    for (std::size_t i = 0; i < 3; ++i) {
        middle.position[i] = 0.5F * (a.position[i] + b.position[i]);
        middle.normal[i] = 0.5F * (a.normal[i] + b.normal[i]);
    }
    middle.surface = 0.5F * (a.surface + b.surface);
    return middle;
}

/// m, below which no edge needs to be halved: the map of straight to bent rays turns by about the gradient
/// over the sound speed a metre, twice that for safety.
double shortest_edge(const Outlook& outlook, double sag) {
    const double curvature = 2 * outlook.rays_nearby->steepest() / outlook.rays_nearby->speed();
    return std::max(0.5, std::sqrt(8 * sag / std::max(curvature, 1e-9)));
}

}  // namespace

/// Splits the triangles of one part's nodes.
class SplitScene::Splitter {
  public:
    Splitter(const Scene& scene, SplitMesh& to, const RayTable& rays, Vec3 eye, Vec3 up, double reach,
             double sag, double shortest)
        : scene_(scene),
          to_(to),
          rays_(rays),
          eye_(eye),
          up_(up),
          reach_(reach),
          sag_(sag),
          shortest_(shortest) {}

    void add(std::uint32_t number) {
        const SceneNode& node = scene_.nodes()[number];
        const auto vertices = node.coarse ? scene_.coarse_vertices() : scene_.vertices();
        const auto indices = (node.coarse ? scene_.coarse_indices() : scene_.indices())
                                 .subspan(node.first_index, node.indices);
        vertices_.clear(), bent_.clear(), middles_.clear(), patch_.clear();
        for (const SceneVertex& vertex : vertices.subspan(node.first_vertex, node.vertices)) push(vertex);
        double_sided_ = scene_.materials()[node.material].double_sided;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
            split(indices[i], indices[i + 1], indices[i + 2], 0);
        end_patch();
    }

  private:
    static constexpr std::uint32_t whole = ~0U;

    std::uint32_t push(const SceneVertex& vertex) {
        vertices_.push_back(vertex);
        bent_.push_back(bend(place_of(vertex) - eye_));
        return static_cast<std::uint32_t>(vertices_.size() - 1);
    }

    Vec3 bend(Vec3 straight) const {
        const double height = dot(straight, up_);
        const Vec3 level = straight - height * up_;
        const double x = norm(level);
        const RayTable::Move move = rays_.move(x, -height);
        return straight + static_cast<double>(move.outwards) * level + static_cast<double>(move.rise) * up_;
    }

    /// The vertex in the middle of an edge that is to be halved, else `whole`.
    std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
        if (const auto known = middles_.find(key); known != middles_.end()) return known->second;
        // In one order, whichever triangle asks.
        if (vertices_[b].position < vertices_[a].position) std::swap(a, b);
        std::uint32_t made = whole;
        const Vec3 from = place_of(vertices_[a]) - eye_, along = place_of(vertices_[b]) - eye_ - from;
        const double length = norm(along);
        if (length > shortest_) {
            const double share = std::clamp(-dot(from, along) / (length * length), 0.0, 1.0);
            if (norm(from + share * along) < reach_) {
                if (length > reach_ / 2 || stray(a, b, from, along) > sag_)
                    made = push(middle_of(vertices_[a], vertices_[b]));
            }
        }
        middles_.emplace(key, made);
        return made;
    }

    /// m, by which the bent edge strays from the straight one between its ends.
    double stray(std::uint32_t a, std::uint32_t b, Vec3 from, Vec3 along) const {
        double most = 0;
        for (const double part : {0.25, 0.5, 0.75})
            most = std::max(most, norm(bend(from + part * along) - (1 - part) * bent_[a] - part * bent_[b]));
        return most;
    }

    void split(std::uint32_t a, std::uint32_t b, std::uint32_t c, int depth) {
        if (depth < deepest) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            const int halved = (ab != whole) + (bc != whole) + (ca != whole);
            // Turned so that the edges that stay whole come last.
            if (halved == 3) {
                split(a, ab, ca, depth + 1), split(ab, b, bc, depth + 1);
                split(ca, bc, c, depth + 1), split(ab, bc, ca, depth + 1);
                return;
            }
            if (halved == 2) {
                if (ab == whole) return split_two(b, c, a, bc, ca, depth + 1);
                if (bc == whole) return split_two(c, a, b, ca, ab, depth + 1);
                return split_two(a, b, c, ab, bc, depth + 1);
            }
            if (halved == 1) {
                if (ab != whole) return split(a, ab, c, depth + 1), split(ab, b, c, depth + 1);
                if (bc != whole) return split(b, bc, a, depth + 1), split(bc, c, a, depth + 1);
                return split(c, ca, b, depth + 1), split(ca, a, b, depth + 1);
            }
        }
        emit(a, b, c);
    }

    /// Of the triangle a, b, c the edges a b and b c are halved.
    void split_two(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t ab, std::uint32_t bc,
                   int depth) {
        split(ab, b, bc, depth), split(a, ab, c, depth), split(ab, bc, c, depth);
    }

    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        patch_.insert(patch_.end(), {a, b, c});
        if (patch_.size() >= 3 * patch_triangles) end_patch();
    }

    /// Each patch has vertices of its own, those in a node's order, so that no more are bent than it needs.
    void end_patch() {
        if (patch_.empty()) return;
        SplitMesh::Patch patch{{static_cast<std::uint32_t>(to_.vertices_.size()), 0,
                                static_cast<std::uint32_t>(to_.indices_.size()),
                                static_cast<std::uint32_t>(patch_.size()), double_sided_},
                               empty_bounds()};
        own_ = patch_;
        std::ranges::sort(own_);
        own_.erase(std::ranges::unique(own_).begin(), own_.end());
        for (const std::uint32_t vertex : own_) {
            to_.vertices_.push_back(vertices_[vertex]);
            grow(patch.bounds, vertices_[vertex].position);
        }
        for (const std::uint32_t corner : patch_)
            to_.indices_.push_back(
                static_cast<std::uint16_t>(std::ranges::lower_bound(own_, corner) - own_.begin()));
        patch.drawn.vertices = static_cast<std::uint32_t>(own_.size());
        to_.patches_.push_back(patch);
        patch_.clear();
    }

    const Scene& scene_;
    SplitMesh& to_;
    const RayTable& rays_;
    Vec3 eye_, up_;
    double reach_, sag_, shortest_;
    bool double_sided_ = false;
    std::vector<SceneVertex> vertices_;       ///< of the node at hand, and the middles of its edges
    std::vector<Vec3> bent_;                  ///< the same
    std::vector<std::uint32_t> patch_, own_;  ///< corners of the patch at hand; each once
    std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

bool SplitScene::is_long(std::uint32_t node, double shortest) {
    if (longest_.empty())
        for (const SceneNode& each : scene_->nodes()) {
            const auto vertices = each.coarse ? scene_->coarse_vertices() : scene_->vertices();
            const auto indices = each.coarse ? scene_->coarse_indices() : scene_->indices();
            double longest = 0;
            for (std::size_t i = each.first_index; i + 2 < each.first_index + each.indices; i += 3)
                for (std::size_t side = 0; side < 3; ++side)
                    longest = std::max(
                        longest, norm(place_of(vertices[each.first_vertex + indices[i + side]]) -
                                      place_of(vertices[each.first_vertex + indices[i + (side + 1) % 3]])));
            longest_.push_back(static_cast<float>(longest));
        }
    return static_cast<double>(longest_[node]) > shortest;
}

/// Keeps what is known only where it was made for the same.
void SplitScene::start(SplitMesh& mesh, const Outlook& outlook, double sag, const SeenView& seen) {
    std::vector<SplitMesh::Place> places;
    const auto rounded = [](Vec3 v, double step) {
        return step * Vec3{std::round(v.x / step), std::round(v.y / step), std::round(v.z / step)};
    };
    for (const SeenNodes& part : seen.parts) {
        const Vec3 up = rounded(part.up, 1.0 / 16);
        places.push_back({rounded(part.frame_from_fan.position, lattice), 1 / norm(up) * up});
    }
    constexpr std::size_t most = 300'000;  // vertices that pile up while a sonar turns
    if (places == mesh.places_ && mesh.rays_ == outlook.rays_nearby && mesh.sag_ == sag &&
        mesh.end_range_ == outlook.end_range && mesh.vertices_.size() < most)
        return;
    ++mesh.version_;
    mesh.vertices_.clear(), mesh.indices_.clear(), mesh.patches_.clear(), mesh.known_.clear();
    mesh.places_ = std::move(places), mesh.rays_ = outlook.rays_nearby;
    mesh.sag_ = sag, mesh.end_range_ = outlook.end_range;
}

void SplitScene::split(const Outlook& outlook, std::vector<SeenView>& seen) {
    bool started[2] = {false, false};
    for (SeenView& view : seen) {
        const bool surround = view.view->surround;
        const double sag = (surround ? 8 : 1) * outlook.sag;
        if (!std::exchange(started[surround], true)) start(meshes_[surround], outlook, sag, view);
        split_view(meshes_[surround], outlook, sag, view);
    }
}

void SplitScene::split_view(SplitMesh& mesh, const Outlook& outlook, double sag, SeenView& view) {
    const double shortest = shortest_edge(outlook, sag);
    const ViewLimits limits = limits_of(*view.view, outlook);
    const double reach = outlook.end_range * (1.02 + outlook.rays_nearby->most_stretch()) + lattice;
    for (std::size_t part = 0; part < view.parts.size(); ++part) {
        SeenNodes& own = view.parts[part];
        Splitter splitter(*scene_, mesh, *outlook.rays_nearby, mesh.places_[part].eye, mesh.places_[part].up,
                          reach, sag, shortest);
        const SeenBoxes boxes(*view.view, own.frame_from_fan, limits, own.up);
        long_.clear();
        std::erase_if(own.nodes, [&](std::uint32_t node) {
            const bool is = is_long(node, shortest);
            if (is) long_.push_back(node);
            return is;
        });
        for (const std::uint32_t node : long_) {
            auto stretch = mesh.known_.find(node);
            if (stretch == mesh.known_.end()) {
                const auto first = static_cast<std::uint32_t>(mesh.patches_.size());
                splitter.add(node);
                const auto last = static_cast<std::uint32_t>(mesh.patches_.size());
                stretch = mesh.known_.emplace(node, SplitMesh::Stretch{first, last}).first;
                ++mesh.version_;
            }
            view.triangles -= scene_->nodes()[node].indices / 3;
            for (std::uint32_t i = stretch->second.first; i < stretch->second.last; ++i) {
                const SplitMesh::Patch& patch = mesh.patches_[i];
                if (!boxes.has(patch.bounds)) continue;
                own.patches.push_back(patch.drawn);
                view.triangles += patch.drawn.indices / 3;
            }
        }
    }
}

}  // namespace echoloop::gl
