#include "render/raster/view_painter.h"

#include <algorithm>
#include <cstring>

#include "render/raster/seen_samples.h"
#include "render/simd.h"

namespace echoloop::raster {
namespace {

/// Samples that are looked at together; arrays go on as far beyond the last one.
constexpr int samples_at_once = 16;

Four four(const float* from) {
    Four four;
    std::memcpy(&four, from, sizeof four);
    return four;
}

Four normal_and_surface(const SceneVertex& vertex) {
    static_assert(sizeof(SceneVertex) == 7 * sizeof(float));
    return four(reinterpret_cast<const float*>(&vertex) + 3);
}

/// What may be seen of a node, and where it goes. `numbers` of each triangle, as ViewPainter::Shown begins,
/// lie `step` floats apart. `clear`: a fifth plane, which is not negative where there is no shadow, and whose
/// numbers lie a padded `count` apart; null: all is lit.
struct Cover {
    const SeenTriangle* seen;
    int count;
    const float* numbers;
    std::size_t step;
    const float* clear;
    const float *x_of, *y_of;
    float* inverse;
    std::int32_t* number;
    std::size_t line_stride;
    std::int32_t first_number;
};

/// Puts each where it is nearer than what is there. `at_once`: samples of a vector; most triangles cover no
/// more.
template <bool shadows, int at_once>
ECHOLOOP_INLINE void cover_each(const Cover all) {
    static_assert(at_once <= samples_at_once);
    constexpr float most = 1 / near_end;
    const std::size_t row = padded(static_cast<std::size_t>(all.count));
    const float* const clear_up = shadows ? all.clear + row : nullptr;
    const float* const clear_at_0 = shadows ? clear_up + row : nullptr;
    for (int i = 0; i < all.count; ++i) {
        const SeenTriangle triangle = all.seen[i];
        const float* p = all.numbers + static_cast<std::size_t>(i) * all.step;
        const Four along_x = four(p), at_0 = four(p + 8);
        const float a_up = p[4], b_up = p[5], c_up = p[6], d_up = p[7];
        const float e_up = shadows ? clear_up[i] : 0;
        const std::int32_t own = all.first_number + i;
        const int samples = (triangle.last_sample - triangle.first_sample + at_once) & -at_once;
        const float* __restrict const y = all.y_of + triangle.first_sample;
        for (int line = triangle.first_line; line <= triangle.last_line; ++line) {
            const float x = all.x_of[line];
            const Four across = along_x * x + at_0;
            const float a = across[0], b = across[1], c = across[2], d = across[3],
                        e = shadows ? all.clear[i] * x + clear_at_0[i] : 0;
            const std::size_t at = static_cast<std::size_t>(line) * all.line_stride +
                                   static_cast<std::size_t>(triangle.first_sample);
            float* __restrict const depth = all.inverse + at;
            std::int32_t* __restrict const named = all.number + at;
#pragma GCC ivdep
            for (int k = 0; k < samples; ++k) {
                float inside = std::min(std::min(a + a_up * y[k], b + b_up * y[k]), c + c_up * y[k]);
                if (shadows) inside = std::min(inside, e + e_up * y[k]);
                const float found = d + d_up * y[k], before = depth[k];
                const bool nearest = (inside >= 0) & (found > before) & (found < most);
                depth[k] = nearest ? found : before;
                named[k] = nearest ? own : named[k];
            }
        }
    }
}

template <int at_once>
ECHOLOOP_INLINE void cover_by(const Cover& all) {
    all.clear != nullptr ? cover_each<true, at_once>(all) : cover_each<false, at_once>(all);
}

#ifdef ECHOLOOP_SIMD_VERSIONS
__attribute__((target("arch=x86-64-v4"))) void cover(const Cover& all) { cover_by<16>(all); }
__attribute__((target("arch=x86-64-v3"))) void cover(const Cover& all) { cover_by<8>(all); }
__attribute__((target("default")))
#endif
void
cover(const Cover& all) {
    cover_by<8>(all);
}

std::span<const SceneVertex> vertices_of(const Scene& scene, const SceneNode& node) {
    return (node.coarse ? scene.coarse_vertices() : scene.vertices())
        .subspan(node.first_vertex, node.vertices);
}

std::span<const std::uint16_t> indices_of(const Scene& scene, const SceneNode& node) {
    return (node.coarse ? scene.coarse_indices() : scene.indices()).subspan(node.first_index, node.indices);
}

/// Has the memory send what will be wanted, since nodes lie scattered.
template <typename Value>
void fetch(std::span<const Value> values) {
    constexpr std::size_t line = 64;
    const auto* const begin = reinterpret_cast<const char*>(values.data());
    for (std::size_t i = 0; i < values.size_bytes(); i += line) __builtin_prefetch(begin + i);
}

void fetch(const Scene& scene, const SceneNode& node) {
    fetch(vertices_of(scene, node));
    fetch(indices_of(scene, node));
}

}  // namespace

void ViewPainter::paint(const Painting& painting, const gl::SeenView& seen) {
    const Scene& scene = painting.scene;
    start(*seen.view, painting.offset);
    for (const gl::SeenNodes& part : seen.parts) {
        const PartPlace& place = places_.emplace_back(*seen.view, part.frame_from_fan, part.up);
        auto& columns = columns_.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
            columns[k] = {place.rows[k], place.rows[3 + k], place.rows[6 + k], 0};
        for (std::size_t i = 0; i < part.nodes.size(); ++i) {
            const SceneNode& node = scene.nodes()[part.nodes[i]];
            if (i + 1 < part.nodes.size()) fetch(scene, scene.nodes()[part.nodes[i + 1]]);
            triangles_.take(indices_of(scene, node));
            paint_triangles(vertices_of(scene, node), painting,
                            scene.materials()[node.material].double_sided);
        }
        for (const gl::SeenPatch& patch : part.patches) {
            const gl::SplitMesh& mesh = painting.split->mesh(seen.view->surround);
            triangles_.take(mesh.indices().subspan(patch.first_index, patch.indices));
            paint_triangles(mesh.vertices().subspan(patch.first_vertex, patch.vertices), painting,
                            patch.double_sided);
        }
    }
    write(painting, *seen.view);
}

void ViewPainter::start(const View& view, SampleOffsets offset) {
    const PixelOffset moved = offset.of(view);
    const auto f = [](double v) { return static_cast<float>(v); };
    grid_ = {f(view.x(0.5 + moved.line)), f(1 / view.line_width()),     f(view.y(0.5 + moved.sample)),
             f(1 / view.sample_height()), static_cast<int>(view.lines), static_cast<int>(view.samples)};
    stride_ = view.samples + samples_at_once;
    x_.resize(view.lines), y_.resize(stride_);
    for (std::size_t line = 0; line < view.lines; ++line)
        x_[line] = f(view.x(static_cast<double>(line) + 0.5 + moved.line));
    for (std::size_t sample = 0; sample < stride_; ++sample)
        y_[sample] = f(view.y(static_cast<double>(sample) + 0.5 + moved.sample));
    inverse_.assign(view.lines * stride_, 0), number_.assign(view.lines * stride_, 0);
    shown_.assign(1, {}), bows_.clear();
    places_.clear(), columns_.clear();
}

/// Of those taken, with these corners.
void ViewPainter::paint_triangles(std::span<const SceneVertex> vertices, const Painting& painting,
                                  bool double_sided) {
    corners_.find(vertices, places_.back(), grid_, painting.rays);
    triangles_.find(corners_, double_sided, grid_);
    const auto seen = triangles_.seen();
    if (seen.empty()) return;
    const std::size_t first = shown_.size();
    add_shown(vertices, painting.rays != nullptr);
    const bool shadow = painting.rays != nullptr && painting.rays->has_shadow();
    if (shadow) triangles_.find_clear(corners_.clearance());
    cover({seen.data(), static_cast<int>(seen.size()), shown_[first].numbers.data(),
           sizeof(Shown) / sizeof(float), shadow ? triangles_.planes(TrianglePlanes::clear) : nullptr,
           x_.data(), y_.data(), inverse_.data(), number_.data(), stride_, static_cast<std::int32_t>(first)});
}

void ViewPainter::add_shown(std::span<const SceneVertex> vertices, bool bent) {
    const auto seen = triangles_.seen();
    const std::size_t first = shown_.size();
    shown_.resize(first + seen.size());
    const auto part = static_cast<std::int32_t>(places_.size() - 1);
    const float* const planes = triangles_.planes(0);
    const std::size_t stride = triangles_.stride();
    for (std::size_t i = 0; i < seen.size(); ++i) {
        Shown& shown = shown_[first + i];
        for (std::size_t k = 0; k < 4; ++k) {
            shown.numbers[k] = planes[3 * k * stride + i];
            shown.numbers[4 + k] = planes[(3 * k + 1) * stride + i];
            shown.numbers[8 + k] = planes[(3 * k + 2) * stride + i];
        }
        for (std::size_t k = 0; k < 3; ++k) shown.vertices[k] = &vertices[triangles_.corner(i, k)];
        shown.part = part;
        // The view's axes are left-handed, so what is square to a front points away from us.
        shown.side = seen[i].turned != 0 ? 1.0F : -1.0F;
    }
    if (!bent) return;
    bows_.resize(shown_.size());
    const float* const bow = corners_.bow();
    for (std::size_t i = 0; i < seen.size(); ++i)
        bows_[first + i] =
            Four{bow[triangles_.corner(i, 0)], bow[triangles_.corner(i, 1)], bow[triangles_.corner(i, 2)], 0};
}

/// What the samples show from `at` on: normals and all as the shares of the corners say, in the view's axes.
void ViewPainter::look(std::size_t at, float x, const float* y, std::size_t count, rays::HitArrays& hits,
                       float* bow) const {
    constexpr std::size_t long_run = 6;
    for (std::size_t i = 0; i < count;) {
        const std::int32_t number = number_[at + i];
        std::size_t end = i + 1;
        while (end < count && number_[at + end] == number) ++end;
        if (number == 0)
            std::fill(&hits.surface[i], &hits.surface[0] + end, 0.0F);
        else if (end - i >= long_run)
            look_at_many(static_cast<std::size_t>(number), x, y, i, end, hits, bow);
        else
            for (std::size_t k = i; k < end; ++k)
                look_at(static_cast<std::size_t>(number), x, y[k], k, hits, bow);
        i = end;
    }
}

Four ViewPainter::turned(Four normal, std::int32_t part) const {
    const auto& columns = columns_[static_cast<std::size_t>(part)];
    return normal[0] * four(columns[0].data()) + normal[1] * four(columns[1].data()) +
           normal[2] * four(columns[2].data());
}

void ViewPainter::look_at(std::size_t number, float x, float y, std::size_t to, rays::HitArrays& hits,
                          float* bow) const {
    const Shown& shown = shown_[number];
    const float* const numbers = shown.numbers.data();
    const Four along_x = four(numbers), along_y = four(numbers + 4), at_0 = four(numbers + 8);
    const Four here = along_x * x + at_0 + along_y * y;
    const Four share = here / (here[0] + here[1] + here[2]);
    // The normal, and the surface.
    Four seen = share[0] * normal_and_surface(*shown.vertices[0]) +
                share[1] * normal_and_surface(*shown.vertices[1]) +
                share[2] * normal_and_surface(*shown.vertices[2]);
    const float surface = seen[3] + 0.25F;
    if (!bows_.empty()) {
        const Four bows = share * bows_[number];
        bow[to] = bows[0] + bows[1] + bows[2];
    }
    seen = turned(seen, shown.part);
    const Four plane = shown.side * Four{along_x[3], along_y[3], at_0[3], 0};
    hits.depth[to] = 1 / here[3];
    hits.normal_x[to] = seen[0], hits.normal_y[to] = seen[1], hits.normal_z[to] = seen[2];
    hits.plane_x[to] = plane[0], hits.plane_y[to] = plane[1], hits.plane_z[to] = plane[2];
    hits.surface[to] = static_cast<float>(static_cast<int>(surface));
    hits.lean[to] = std::max(surface - hits.surface[to] - 0.25F, 0.0F);
}

void ViewPainter::look_at_many(std::size_t number, float x, const float* y, std::size_t first,
                               std::size_t last, rays::HitArrays& hits, float* bow) const {
    const Shown& shown = shown_[number];
    Along along{};
    along.side = shown.side, along.x = x;
    std::ranges::copy(shown.numbers, along.numbers);
    for (std::size_t k = 0; k < 3; ++k) {
        const Four corner = normal_and_surface(*shown.vertices[k]);
        along.surfaces[k] = corner[3];
        const Four normal = turned(corner, shown.part);
        std::memcpy(&along.normals[3 * k], &normal, 3 * sizeof(float));
    }
    look_along(along, y + first, static_cast<int>(last - first), &hits.depth[first], &hits.normal_x[first],
               &hits.normal_y[first], &hits.normal_z[first], &hits.plane_x[first], &hits.plane_y[first],
               &hits.plane_z[first], &hits.surface[first], &hits.lean[first]);
    if (bows_.empty()) return;
    const Four& bows = bows_[number];
    bow_along(along, bows[0], bows[1], bows[2], y + first, static_cast<int>(last - first), bow + first);
}

void ViewPainter::write(const Painting& painting, const View& view) {
    constexpr rays::ViewAxes own_axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const rays::PixelSizes sizes{static_cast<float>(view.line_width()),
                                 static_cast<float>(view.sample_height()),
                                 static_cast<float>(view.usual_width), static_cast<float>(view.usual_height)};
    rays::HitArrays hits{};
    rays::Bows bows{places_.empty() ? std::array<float, 3>{} : places_.front().up_seen, {}};
    for (std::size_t line = 0; line < view.lines; ++line)
        for (std::size_t sample = 0; sample < view.samples; sample += rays::HitArrays::most) {
            const std::size_t count = std::min(rays::HitArrays::most, view.samples - sample);
            look(line * stride_ + sample, x_[line], &y_[sample], count, hits, bows.of.data());
            rays::find_pixels(own_axes, sizes, x_[line], &y_[sample], hits, count,
                              painting.image + (view.first_line + line) * painting.samples + sample,
                              bows_.empty() ? nullptr : &bows);
        }
}

}  // namespace echoloop::raster
