#include "render/rays/ray_sampler.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace echoloop::rays {
namespace {

constexpr std::size_t lines_per_piece = 4 * tile_lines;

/// The next power of 2^(1/4) that is not greater, or not less: so that pings of nearly the same kind share
/// trees.
double step_down(double value) { return std::exp2(std::floor(4 * std::log2(value)) / 4); }
double step_up(double value) { return std::exp2(std::ceil(4 * std::log2(value)) / 4); }

/// m, between the places for which trees are made: the farther a sonar sees, the farther it may go with one.
double lattice_of(double reach) {
    constexpr double steps_of_reach = 12;
    return std::exp2(std::floor(std::log2(reach / steps_of_reach)));
}

Vec3 nearest_place(Vec3 eye, double lattice) {
    const auto nearest = [&](double v) { return lattice * std::round(v / lattice) + 0.0; };
    return {nearest(eye.x), nearest(eye.y), nearest(eye.z)};
}

RotationRows rows_of(Quat q) {
    const Vec3 x = rotate(q, {1, 0, 0}), y = rotate(q, {0, 1, 0}), z = rotate(q, {0, 0, 1});
    const auto f = [](double v) { return static_cast<float>(v); };
    return {f(x.x), f(y.x), f(z.x), f(x.y), f(y.y), f(z.y), f(x.z), f(y.z), f(z.z)};
}

/// Follows the rays of one view, some tiles at a time, where they are straight.
class Tracer {
  public:
    Tracer(const ViewPlace& place, std::size_t samples, const TracedParts& parts, float reach)
        : axes_(place.axes),
          sizes_(place.sizes),
          y_(place.y),
          samples_(samples),
          parts_(parts),
          reach_(reach) {
        for (RTCRayHit16& query : queries_)
            for (std::size_t lane = 0; lane < packet_rays; ++lane) {
                query.ray.org_x[lane] = place.eye[0], query.ray.org_y[lane] = place.eye[1],
                query.ray.org_z[lane] = place.eye[2];
                query.ray.time[lane] = 0, query.ray.mask[lane] = ~0U, query.ray.flags[lane] = 0;
            }
    }

    /// Those of neighbouring lines, at most tile_lines.
    void trace(std::span<const TracedLine> lines) {
        for (std::size_t lane = 0; lane < packet_rays; ++lane)
            x_[lane] = lines[std::min(lane / tile_samples, lines.size() - 1)].x;
        for (std::size_t sample = 0; sample < samples_; sample += HitArrays::most) {
            const std::size_t count = std::min(HitArrays::most, samples_ - sample);
            const std::size_t needed = (count + tile_samples - 1) / tile_samples;
            for (std::size_t tile = 0; tile < needed; ++tile)
                start(queries_[tile], asked_[tile], sample + tile * tile_samples, lines.size());
            for (std::size_t tile = 0; tile < needed; ++tile)
                first_hits(asked_[tile].data(), parts_.scene(), queries_[tile]);
            for (std::size_t tile = 0; tile < needed; ++tile) take_hits(queries_[tile], tile);
            for (std::size_t line = 0; line < lines.size(); ++line)
                find_pixels(axes_, sizes_, lines[line].x, &y_[sample], hits_[line], count,
                            lines[line].pixels + sample);
        }
    }

  private:
    struct alignas(packet_alignment) Asked : std::array<int, packet_rays> {};

    void start(RTCRayHit16& query, Asked& asked, std::size_t sample, std::size_t lines) const {
        float y[packet_rays];
        for (std::size_t lane = 0; lane < packet_rays; ++lane) y[lane] = y_[sample + lane % tile_samples];
        find_directions(axes_, x_.data(), y, query.ray.dir_x, query.ray.dir_y, query.ray.dir_z);
        for (std::size_t lane = 0; lane < packet_rays; ++lane) {
            query.ray.tnear[lane] = near_end;
            query.ray.tfar[lane] = reach_ / std::sqrt(x_[lane] * x_[lane] + y[lane] * y[lane] + 1);
            query.hit.geomID[lane] = query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
            const bool there = lane / tile_samples < lines && sample + lane % tile_samples < samples_;
            asked[lane] = there ? -1 : 0;
        }
    }

    void take_hits(RTCRayHit16& query, std::size_t tile) {
        Asked again{};
        bool any = false;
        for (std::size_t lane = 0; lane < packet_rays; ++lane) {
            HitArrays& to = hits_[lane / tile_samples];
            const std::size_t at = tile * tile_samples + lane % tile_samples;
            to.surface[at] = 0;
            if (query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID || asked_[tile][lane] == 0) continue;
            if (!parts_.take_hit(query, lane, to, at)) again[lane] = -1, any = true;
        }
        while (any) go_on(query, tile, again, any);
    }

    /// What is not there from behind is passed.
    void go_on(RTCRayHit16& query, std::size_t tile, Asked& again, bool& any) {
        for (std::size_t lane = 0; lane < packet_rays; ++lane) {
            if (again[lane] == 0) continue;
            const float depth = query.ray.tfar[lane];
            query.ray.tnear[lane] = depth + std::max(1e-6F * depth, 1e-5F);
            query.ray.tfar[lane] =
                reach_ / std::hypot(query.ray.dir_x[lane], query.ray.dir_y[lane], query.ray.dir_z[lane]);
            query.hit.geomID[lane] = query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
        first_hits(again.data(), parts_.scene(), query);
        any = false;
        for (std::size_t lane = 0; lane < packet_rays; ++lane) {
            if (again[lane] == 0) continue;
            again[lane] = 0;
            if (query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
            HitArrays& to = hits_[lane / tile_samples];
            if (!parts_.take_hit(query, lane, to, tile * tile_samples + lane % tile_samples))
                again[lane] = -1, any = true;
        }
    }

    const ViewAxes axes_;
    const PixelSizes sizes_;
    const std::vector<float> y_;
    std::size_t samples_;
    const TracedParts parts_;
    float reach_;
    std::array<float, packet_rays> x_{};
    std::array<RTCRayHit16, tiles_at_once> queries_;
    std::array<Asked, tiles_at_once> asked_;
    std::array<HitArrays, tile_lines> hits_{};
};

}  // namespace

RaySampler::RaySampler(std::shared_ptr<const Scene> scene, std::size_t threads)
    : scene_(std::move(scene)), device_(embree::new_device()), workers_(threads) {}

std::string RaySampler::description() { return "Embree " RTC_VERSION_STRING; }

RaySampler::Placed RaySampler::placed(const World& world, std::uint32_t part, const gl::Outlook& outlook) {
    const Pose pose = part == 0 ? Pose{} : outlook.movers[part - 1];
    const Vec3 eye = (inverse(pose) * outlook.world_from_fan).position;
    const double reach = step_up(gl::reach_of(outlook)), lattice = lattice_of(reach);
    const TreeKey key{part, nearest_place(eye, lattice), world.tolerance, reach, world.coarse};
    const auto make = [&] {
        gl::ViewLimits limits;
        limits.end_range = reach, limits.tolerance = world.tolerance;
        limits.full_tolerance_range = world.coarse ? gl::full_tolerance_share * reach : 0;
        const gl::NodeRange range = part == 0 ? gl::NodeRange{0, scene_->still_nodes()}
                                              : gl::NodeRange{scene_->movers()[part - 1].first_node,
                                                              scene_->movers()[part - 1].last_node};
        const double radius = 0.5 * std::sqrt(3.0) * lattice;
        auto tree = std::make_shared<const DetailTree>(device_, *scene_, range, key.eye, radius, limits);
        const std::size_t bytes = tree->bytes();
        return std::pair(KnownTree{key, std::move(tree)}, bytes);
    };
    const auto& known = trees_.get([&](const KnownTree& tree) { return tree.key == key; }, make);
    return {known.tree, rows_of(pose.orientation), {}};
}

const RaySampler::World& RaySampler::world_for(const View& view, const gl::Outlook& outlook) {
    const gl::ViewLimits limits = gl::limits_of(view, outlook);
    const double tolerance = step_down(limits.tolerance);
    const bool coarse = limits.full_tolerance_range > 0;
    for (const auto& world : worlds_)
        if (world->tolerance == tolerance && world->coarse == coarse) return *world;
    World& world = *worlds_.emplace_back(std::make_unique<World>());
    world.tolerance = tolerance, world.coarse = coarse;
    for (std::uint32_t part = 0; part <= outlook.movers.size(); ++part)
        world.parts.push_back(placed(world, part, outlook));
    for (const Placed& part : world.parts)
        profile_.triangles += part.tree->triangles(), profile_.chunks += part.tree->chunks();
    if (world.parts.size() == 1) return world;
    world.all.reset(rtcNewScene(device_.get()));
    for (std::uint32_t i = 0; i < world.parts.size(); ++i) {
        Placed& part = world.parts[i];
        if (part.tree->empty()) continue;
        const Vec3 at = i == 0 ? Vec3{} : outlook.movers[i - 1].position;
        const auto& m = part.world_from_part;
        const float transform[12] = {m[0], m[1], m[2], static_cast<float>(at.x),
                                     m[3], m[4], m[5], static_cast<float>(at.y),
                                     m[6], m[7], m[8], static_cast<float>(at.z)};
        part.instance.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
        rtcSetGeometryInstancedScene(part.instance.get(), part.tree->scene());
        rtcSetGeometryTransform(part.instance.get(), 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, transform);
        rtcCommitGeometry(part.instance.get());
        rtcAttachGeometryByID(world.all.get(), part.instance.get(), i);
    }
    rtcCommitScene(world.all.get());
    embree::check_tree_of(device_);
    return world;
}

const RayChains& RaySampler::chains_for(const View& view, const gl::Outlook& outlook) {
    ChordTolerance tolerance{
        outlook.sag * (view.surround ? 8 : 1),
        0.25 * std::min(view.line_width() * view.usual_width, view.sample_height() * view.usual_height)};
    tolerance.distance = step_down(tolerance.distance), tolerance.angle = step_down(tolerance.angle);
    const auto make = [&] {
        return std::pair(
            KnownChains{outlook.rays, tolerance, std::make_unique<const RayChains>(*outlook.rays, tolerance)},
            std::size_t{1});
    };
    return *chains_
                .get(
                    [&](const KnownChains& known) {
                        return known.rays == outlook.rays && known.tolerance == tolerance;
                    },
                    make)
                .chains;
}

void RaySampler::trace(const Piece& piece, const Picture& picture, const gl::Outlook& outlook,
                       Pixel* pixels) {
    const View& view = *piece.view;
    std::vector<TracedParts::Part> trees;
    for (const Placed& part : piece.world->parts) trees.push_back({part.tree.get(), &part.world_from_part});
    const TracedParts parts(piece.world->scene(), trees, piece.world->all != nullptr);
    const ViewPlace place(view, outlook);
    const auto reach =
        static_cast<float>(piece.chains != nullptr ? outlook.end_range : gl::reach_of(outlook));
    const auto trace_with = [&](auto&& tracer) {
        const double moved = outlook.offset.of(view).line;
        for (std::size_t line = piece.first_line; line < piece.last_line; line += tile_lines) {
            std::array<TracedLine, tile_lines> lines;
            const std::size_t count = std::min(tile_lines, piece.last_line - line);
            for (std::size_t i = 0; i < count; ++i)
                lines[i] = {static_cast<float>(view.x(static_cast<double>(line + i) + 0.5 + moved)),
                            pixels + (view.first_line + line + i) * picture.samples};
            tracer.trace(std::span(lines).first(count));
        }
    };
    if (piece.chains != nullptr)
        trace_with(BentTracer(place, view.samples, parts, *piece.chains, reach));
    else
        trace_with(Tracer(place, view.samples, parts, reach));
}

void RaySampler::sample(const Picture& picture, const gl::Outlook& outlook, std::vector<Pixel>& pixels) {
    const auto since = [](auto then) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
    };
    const auto begin = std::chrono::steady_clock::now();
    profile_ = {};
    worlds_.clear(), pieces_.clear();
    for (const View& view : picture.views) {
        const World& world = world_for(view, outlook);
        const RayChains* chains = outlook.rays ? &chains_for(view, outlook) : nullptr;
        profile_.pixels += view.lines * view.samples;
        for (std::size_t line = 0; line < view.lines; line += lines_per_piece)
            pieces_.push_back({&view, &world, chains, line, std::min(line + lines_per_piece, view.lines)});
    }
    profile_.cull = since(begin);
    const auto ready = std::chrono::steady_clock::now();
    pixels.resize(picture.image_lines * picture.samples);
    workers_.run(pieces_.size(), [&](std::size_t i) { trace(pieces_[i], picture, outlook, pixels.data()); });
    profile_.draw = since(ready);
}

}  // namespace echoloop::rays
