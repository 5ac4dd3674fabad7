#include "render/paths/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/paths/embree.h"
#include "render/paths/triangle_set.h"

namespace echoloop {
namespace {

/// Embree's normal has the direction of the winding: a ray that runs along with it comes from behind.
void reject_from_behind(const RTCFilterFunctionNArguments* arguments) {
    const unsigned rays = arguments->N;
    for (unsigned i = 0; i < rays; ++i) {
        RTCRayN* ray = arguments->ray;
        RTCHitN* hit = arguments->hit;
        const float along = RTCRayN_dir_x(ray, rays, i) * RTCHitN_Ng_x(hit, rays, i) +
                            RTCRayN_dir_y(ray, rays, i) * RTCHitN_Ng_y(hit, rays, i) +
                            RTCRayN_dir_z(ray, rays, i) * RTCHitN_Ng_z(hit, rays, i);
        if (along >= 0) arguments->valid[i] = 0;
    }
}

RTCRay embree_ray(Vec3 origin, Vec3 direction, double near, double far) {
    RTCRay ray{};
    ray.org_x = static_cast<float>(origin.x);
    ray.org_y = static_cast<float>(origin.y);
    ray.org_z = static_cast<float>(origin.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tnear = static_cast<float>(near);
    ray.tfar = static_cast<float>(far);
    ray.mask = ~0U;
    return ray;
}

RTCRayHit embree_query(Vec3 origin, Vec3 direction, double near, double far) {
    RTCRayHit query{embree_ray(origin, direction, near, far), {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return query;
}

constexpr std::size_t packet = 16;

/// Sixteen rays, of which the first `count` are asked.
struct Packet {
    alignas(64) RTCRayHit16 query{};
    alignas(64) int asked[packet] = {};

    void set(std::size_t i, const Ray& ray, double near) {
        RTCRay16& to = query.ray;
        to.org_x[i] = static_cast<float>(ray.origin.x), to.org_y[i] = static_cast<float>(ray.origin.y),
        to.org_z[i] = static_cast<float>(ray.origin.z);
        to.dir_x[i] = static_cast<float>(ray.direction.x), to.dir_y[i] = static_cast<float>(ray.direction.y),
        to.dir_z[i] = static_cast<float>(ray.direction.z);
        to.tnear[i] = static_cast<float>(near), to.tfar[i] = static_cast<float>(ray.end);
        to.mask[i] = ~0U;
        query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        asked[i] = -1;
    }
    bool met(std::size_t i) const { return query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID; }
    RTCRayHit of(std::size_t i) const {
        RTCRayHit one{};
        one.ray.tfar = query.ray.tfar[i];
        one.hit.Ng_x = query.hit.Ng_x[i], one.hit.Ng_y = query.hit.Ng_y[i], one.hit.Ng_z = query.hit.Ng_z[i];
        one.hit.primID = query.hit.primID[i], one.hit.geomID = query.hit.geomID[i];
        one.hit.instID[0] = query.hit.instID[0][i];
        return one;
    }
};

/// What a float resolves at the far end of the scene, eight times over.
double skin_of(const Bounds& bounds) {
    float most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        most = std::max({most, std::abs(bounds.min[axis]), std::abs(bounds.max[axis])});
    return std::max(2e-4, 1e-6 * static_cast<double>(most));
}

}  // namespace

using embree::check_tree_of, embree::Device, embree::Geometry, embree::new_device, embree::Tree;

/// What moves together: all that stands still, or one mover.
struct Group {
    TriangleSet sets[2];  ///< there from one side, from both
    Tree tree;
    Geometry instance;  ///< in the tree of all, where that is another
    Quat world_from_group;
};

class RayScene::Impl {
  public:
    Impl(std::shared_ptr<const Scene> scene, double tolerance)
        : scene_(std::move(scene)),
          skin_(skin_of(scene_->bounds())),
          margin_(2 * tolerance),
          device_(new_device()) {
        std::vector<Taken> still = nodes_met(*scene_, 0, scene_->still_nodes(), tolerance), second;
        if (tolerance > 0) {
            const auto coarse = std::ranges::stable_partition(
                still, [&](const Taken& one) { return !scene_->nodes()[one.node].coarse; });
            second.assign(coarse.begin(), coarse.end());
            still.erase(coarse.begin(), coarse.end());
        } else if (triangles_of(*scene_, still) > many_triangles) {
            const auto half = static_cast<std::ptrdiff_t>(still.size() / 2);
            second.assign(still.begin(), still.begin() + half);
            still.erase(still.begin(), still.begin() + half);
        }
        auto rest = std::async(second.empty() ? std::launch::deferred : std::launch::async, [&] {
            if (second.empty()) return;
            second_device_ = new_device();
            build(second_, second_device_.get(), second);
        });
        groups_.resize(1 + scene_->movers().size());
        build(groups_[0], device_.get(), still);
        for (std::size_t i = 0; i < scene_->movers().size(); ++i) {
            const SceneMover& mover = scene_->movers()[i];
            build(groups_[i + 1], device_.get(), nodes_met(*scene_, mover.first_node, mover.last_node, 0));
        }
        if (groups_.size() > 1) join();
        rest.get();
        check_tree_of(device_);
        if (second_device_) check_tree_of(second_device_);
    }

    void place(std::span<const Pose> movers) {
        if (movers.empty()) return;
        Bounds bounds = scene_->still_bounds();
        for (std::size_t i = 0; i < movers.size(); ++i) {
            move(groups_[i + 1], movers[i]);
            const Bounds own = placed(scene_->movers()[i].bounds, movers[i]);
            if (is_empty(own)) continue;
            grow(bounds, own.min);
            grow(bounds, own.max);
        }
        rtcCommitScene(all_.get());
        skin_ = skin_of(bounds);
    }

    std::optional<RayHit> hit(Vec3 origin, Vec3 direction, double end) const {
        RTCRayHit query = embree_query(origin, direction, skin_, end);
        first_hit(tree(), query);
        const Group* group = nullptr;
        if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) group = &groups_[all_ ? query.hit.instID[0] : 0];
        if (second_.tree) {
            RTCRayHit nearer = embree_query(origin, direction, skin_, double{query.ray.tfar});
            first_hit(second_.tree.get(), nearer);
            if (nearer.hit.geomID != RTC_INVALID_GEOMETRY_ID) query = nearer, group = &second_;
        }
        if (group == nullptr) return std::nullopt;
        return hit_of(*group, query, direction);
    }

    void hit(std::span<const Ray> rays, std::span<std::optional<RayHit>> out) const {
        for (std::size_t first = 0; first < rays.size(); first += packet) {
            const auto asked = rays.subspan(first, std::min(packet, rays.size() - first));
            Packet nearest;
            for (std::size_t i = 0; i < asked.size(); ++i) nearest.set(i, asked[i], skin_);
            first_hits(nearest.asked, tree(), nearest.query);
            Packet second;
            if (second_.tree) {
                for (std::size_t i = 0; i < asked.size(); ++i) {
                    Ray nearer = asked[i];
                    nearer.end = double{nearest.query.ray.tfar[i]};
                    second.set(i, nearer, skin_);
                }
                first_hits(second.asked, second_.tree.get(), second.query);
            }
            for (std::size_t i = 0; i < asked.size(); ++i) {
                std::optional<RayHit>& found = out[first + i];
                found.reset();
                if (second.asked[i] != 0 && second.met(i)) {
                    found = hit_of(second_, second.of(i), asked[i].direction);
                } else if (nearest.met(i)) {
                    const RTCRayHit met = nearest.of(i);
                    found = hit_of(groups_[all_ ? met.hit.instID[0] : 0], met, asked[i].direction);
                }
            }
        }
    }

    bool blocked(Vec3 from, Vec3 to) const {
        const double length = norm(to - from);
        if (length <= 2 * skin_) return false;
        RTCRay ray = embree_ray(from, 1 / length * (to - from), skin_, length - skin_);
        any_hit(tree(), ray);
        if (!second_.tree || ray.tfar < 0) return ray.tfar < 0;
        if (margin_ > 0) return stand_in_hides(from, 1 / length * (to - from), length);
        any_hit(second_.tree.get(), ray);
        return ray.tfar < 0;
    }

    double skin() const { return skin_; }

  private:
    RayHit hit_of(const Group& group, const RTCRayHit& met, Vec3 direction) const {
        Vec3 normal{met.hit.Ng_x, met.hit.Ng_y, met.hit.Ng_z};
        if (all_) normal = rotate(group.world_from_group, normal);
        const double twice_area = norm(normal);
        normal = (dot(normal, direction) > 0 ? -1 : 1) / twice_area * normal;
        const TriangleSet& set = group.sets[met.hit.geomID];
        const std::size_t chunk = chunk_of(set, met.hit.primID);
        const double height = set.height[chunk] > 0 ? double{set.height[chunk]}
                                                    : twice_area / longest_side(set, met.hit.primID);
        return {met.ray.tfar, normal, set.material[chunk], set.object[chunk],
                std::max(height, double{set.facet[chunk]})};
    }

    RTCScene tree() const { return all_ ? all_.get() : groups_[0].tree.get(); }

    /// Whether a stand-in lies between two points of which neither is as near to its plane as that may be
    /// off.
    bool stand_in_hides(Vec3 from, Vec3 direction, double length) const {
        constexpr int most = 8;  // passed, one behind the other
        double near = skin_;
        for (int passed = 0; passed < most && near < length - skin_; ++passed) {
            RTCRayHit query = embree_query(from, direction, near, length - skin_);
            first_hit(second_.tree.get(), query);
            if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
            const Vec3 normal{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
            const double at = double{query.ray.tfar},
                         across = std::abs(dot(normal, direction)) / norm(normal);
            if (std::min(at, length - at) * across > margin_) return true;
            near = at + skin_;
        }
        return false;
    }

    /// From so many triangles on what stands still is kept in a third of the memory, where a ray takes a
    /// third longer, by trees that are made in a third of the time; and half of it in a tree of its own,
    /// which another thread makes.
    static constexpr std::size_t many_triangles = 500'000;

    void build(Group& group, RTCDevice device, std::span<const Taken> taken) const {
        group.tree.reset(rtcNewScene(device));
        const bool quickly = triangles_of(*scene_, taken) > many_triangles / 2;
        if (quickly) {
            rtcSetSceneFlags(group.tree.get(), RTC_SCENE_FLAG_COMPACT);
            rtcSetSceneBuildQuality(group.tree.get(), RTC_BUILD_QUALITY_LOW);
        }
        for (const bool double_sided : {false, true}) {
            group.sets[double_sided] = collect(*scene_, taken, double_sided);
            attach(group, device, double_sided, quickly);
        }
        rtcCommitScene(group.tree.get());
    }

    /// Groups keep their own trees, so that only the tree above them is made anew when something has moved.
    void join() {
        all_.reset(rtcNewScene(device_.get()));
        for (std::uint32_t i = 0; i < groups_.size(); ++i) {
            groups_[i].instance.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
            rtcSetGeometryInstancedScene(groups_[i].instance.get(), groups_[i].tree.get());
            move(groups_[i], i == 0 ? Pose{} : scene_->movers()[i - 1].rest);
            rtcAttachGeometryByID(all_.get(), groups_[i].instance.get(), i);
        }
        rtcCommitScene(all_.get());
    }

    static void move(Group& group, const Pose& pose) {
        const Vec3 columns[4] = {rotate(pose.orientation, {1, 0, 0}), rotate(pose.orientation, {0, 1, 0}),
                                 rotate(pose.orientation, {0, 0, 1}), pose.position};
        float transform[12];
        for (std::size_t i = 0; i < 4; ++i) {
            transform[3 * i] = static_cast<float>(columns[i].x);
            transform[3 * i + 1] = static_cast<float>(columns[i].y);
            transform[3 * i + 2] = static_cast<float>(columns[i].z);
        }
        rtcSetGeometryTransform(group.instance.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform);
        rtcCommitGeometry(group.instance.get());
        group.world_from_group = pose.orientation;
    }

    void attach(Group& group, RTCDevice device, bool double_sided, bool quickly) const {
        const TriangleSet& set = group.sets[double_sided];
        if (set.corners.empty()) return;
        const Geometry mesh(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
        // The position is followed by the normal, so that reading 16 bytes for a vertex stays within it.
        rtcSetSharedGeometryBuffer(mesh.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   scene_->all_vertices().data(), 0, sizeof(SceneVertex),
                                   scene_->all_vertices().size());
        rtcSetSharedGeometryBuffer(mesh.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, set.corners.data(),
                                   0, 3 * sizeof(std::uint32_t), set.corners.size() / 3);
        if (!double_sided) {
            rtcSetGeometryIntersectFilterFunction(mesh.get(), reject_from_behind);
            rtcSetGeometryOccludedFilterFunction(mesh.get(), reject_from_behind);
        }
        if (quickly) rtcSetGeometryBuildQuality(mesh.get(), RTC_BUILD_QUALITY_LOW);
        rtcCommitGeometry(mesh.get());
        rtcAttachGeometryByID(group.tree.get(), mesh.get(), double_sided);
    }

    double longest_side(const TriangleSet& set, std::uint32_t triangle) const {
        const std::uint32_t* corner = &set.corners[3 * std::size_t{triangle}];
        double longest = 0;
        for (int i = 0; i < 3; ++i) {
            const auto &a = scene_->vertices()[corner[i]].position,
                       &b = scene_->vertices()[corner[(i + 1) % 3]].position;
            longest =
                std::max(longest, std::hypot(double{a[0]} - b[0], double{a[1]} - b[1], double{a[2]} - b[2]));
        }
        return longest;
    }

    static std::size_t chunk_of(const TriangleSet& set, std::uint32_t triangle) {
        const auto after = std::upper_bound(set.first.begin(), set.first.end(), triangle);
        return static_cast<std::size_t>(after - set.first.begin()) - 1;
    }

    std::shared_ptr<const Scene> scene_;
    double skin_, margin_;  ///< m; the second is that of stand-ins
    Device device_, second_device_;
    std::vector<Group> groups_;
    Group second_;  ///< of what stands still the stand-ins, or of a large scene half of it
    Tree all_;      ///< nullptr where nothing moves
};

RayScene::RayScene(std::shared_ptr<const Scene> scene, double tolerance)
    : impl_(std::make_unique<Impl>(std::move(scene), tolerance)) {}
RayScene::~RayScene() = default;
std::optional<RayHit> RayScene::hit(Vec3 origin, Vec3 direction, double end) const {
    return impl_->hit(origin, direction, end);
}
void RayScene::hit(std::span<const Ray> rays, std::span<std::optional<RayHit>> out) const {
    impl_->hit(rays, out);
}
bool RayScene::blocked(Vec3 from, Vec3 to) const { return impl_->blocked(from, to); }
void RayScene::place(std::span<const Pose> movers) { impl_->place(movers); }
double RayScene::skin() const { return impl_->skin(); }

}  // namespace echoloop
