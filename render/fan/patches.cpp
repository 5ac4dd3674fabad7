#include "render/fan/patches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/acoustics/random.h"
#include "render/acoustics/vector_math.h"
#include "render/simd.h"

namespace echoloop {
namespace {

constexpr double neper_per_db = 0.2302585;  // of power: 1 / 4.343
constexpr std::uint32_t all_cells =
    static_cast<std::uint32_t>(PatchNoise::size * PatchNoise::size * PatchNoise::size) - 1;

/// Turned against the world and each other, so that the noise does not repeat along a wall or a track.
const Quat& turn_of_scale(std::size_t scale) {
    static const std::array turns{axis_angle({0.48, 0.6, 0.64}, 0.7), axis_angle({-0.64, 0.48, 0.6}, 1.9)};
    return turns[scale];
}

double cell_of_scale(std::size_t scale) { return Patches::lengths[scale] / PatchNoise::length; }

/// A point in cells of a scale, within the noise's period.
Vec3 in_cells(Vec3 point, std::size_t scale) {
    const Vec3 turned = 1 / cell_of_scale(scale) * rotate(turn_of_scale(scale), point);
    const auto within = [](double v) { return v - PatchNoise::size * std::floor(v / PatchNoise::size); };
    return {within(turned.x), within(turned.y), within(turned.z)};
}

std::uint32_t key_of(const std::string& name) {
    std::uint64_t key = 0;
    for (const char c : name) key = mix(key, static_cast<unsigned char>(c));
    return static_cast<std::uint32_t>(key) & all_cells;
}

/// A line of directions in cells of a scale: the eye, and what a metre adds towards (1, x, 0) and for y; and
/// upwards in the world.
struct LineOfCells {
    std::array<float, 3> eye, ahead, up, upwards;
    float width, height;  ///< of a usual pixel on the image plane, in correlation lengths per metre of range
};

struct LineShape {
    float x_square, top, sample_height;
};

/// Where the rays of a line lead: RayTable::Place of each pixel, or none where they are straight.
struct BentLine {
    std::vector<float> along, rise;

    void find(const RayTable& rays, const Quat& world_from_view, double x, const LineShape& shape,
              const float* range, std::size_t count) {
        along.resize(count), rise.resize(count);
        const auto up_of = [&](Vec3 axis) { return static_cast<float>(rotate(world_from_view, axis).z); };
        const float base = up_of({1, -x, 0}), up = up_of({0, 0, 1});
        for (std::size_t i = 0; i < count; ++i) {
            const float y = shape.top - static_cast<float>(static_cast<int>(i)) * shape.sample_height;
            const RayTable::Place place =
                rays.place((base + y * up) / std::sqrt(1 + shape.x_square + y * y), range[i]);
            along[i] = place.along, rise[i] = place.rise;
        }
    }
};

/// The cell of each pixel, and the share of the noise that a pixel of that size leaves. `along`, `rise`: as
/// BentLine has them.
template <bool bent>
ECHOLOOP_INLINE void find_cells(const LineOfCells& line, const LineShape& shape,
                                const float* __restrict range, const float* __restrict cosine,
                                const float* __restrict along_ray, const float* __restrict rise,
                                std::size_t count, std::uint32_t* __restrict cell, float* __restrict share) {
    constexpr float positive = 262144, root_pi = 1.7724539F;
    constexpr auto mask = static_cast<std::int32_t>(PatchNoise::size - 1);
    for (std::size_t i = 0; i < count; ++i) {
        const float y = shape.top - static_cast<float>(static_cast<int>(i)) * shape.sample_height;
        const float r = std::min(range[i], 5000.0F), way = r / std::sqrt(1 + shape.x_square + y * y);
        const auto along = [&](int axis) {
            const auto a = static_cast<std::size_t>(axis);
            const float place = bent ? line.eye[a] + way * along_ray[i] * (line.ahead[a] + y * line.up[a]) +
                                           r * rise[i] * line.upwards[a]
                                     : line.eye[a] + way * (line.ahead[a] + y * line.up[a]);
            return static_cast<std::int32_t>(place + positive) & mask;
        };
        cell[i] = static_cast<std::uint32_t>(along(0) +
                                             PatchNoise::size * (along(1) + PatchNoise::size * along(2)));
        const float wide = line.width * r / root_pi,
                    deep = line.height * r / (root_pi * std::max(cosine[i], 0.02F));
        share[i] = 1 / std::sqrt(std::sqrt((1 + wide * wide) * (1 + deep * deep)));
    }
}

ECHOLOOP_SIMD
void find_cells(const LineOfCells line, const LineShape shape, const float* __restrict range,
                const float* __restrict cosine, std::size_t count, std::uint32_t* __restrict cell,
                float* __restrict share) {
    find_cells<false>(line, shape, range, cosine, nullptr, nullptr, count, cell, share);
}

ECHOLOOP_SIMD
void find_bent_cells(const LineOfCells line, const LineShape shape, const float* __restrict range,
                     const float* __restrict cosine, const float* __restrict along_ray,
                     const float* __restrict rise, std::size_t count, std::uint32_t* __restrict cell,
                     float* __restrict share) {
    find_cells<true>(line, shape, range, cosine, along_ray, rise, count, cell, share);
}

/// Of samples that show one surface: adds what one scale leaves of its noise, and the variance of that. In
/// tiles, since bytes here and there in a table are read one by one.
ECHOLOOP_SIMD
void add_noise(const std::int8_t* values, std::uint32_t key, const std::uint32_t* __restrict cell,
               const float* __restrict share, std::size_t count, float* __restrict noise,
               float* __restrict variance) {
    constexpr float half = 0.70710678F * PatchNoise::scale;
    constexpr std::size_t tile = 64;
    float read[tile];
    for (std::size_t first = 0; first < count; first += tile) {
        const std::size_t used = std::min(tile, count - first);
        for (std::size_t i = 0; i < used; ++i)
            read[i] = static_cast<float>(values[(cell[first + i] + key) & all_cells]);
        for (std::size_t i = 0; i < used; ++i) {
            const float left = share[first + i];
            noise[first + i] += half * left * read[i];
            variance[first + i] += 0.5F * left * left;
        }
    }
}

/// out = weight exp(s n - s^2 v / 2).
ECHOLOOP_SIMD
void multiply_by_patches(const float* weight, float strength, const float* __restrict noise,
                         const float* __restrict variance, std::size_t count, float* out) {
    for (std::size_t i = 0; i < count; ++i)
        out[i] = weight[i] * vector_math::exp(strength * (noise[i] - 0.5F * strength * variance[i]));
}

constexpr std::size_t smoothing_reach = 10, smoothing_taps = 2 * smoothing_reach + 1;

/// One axis of a cube that repeats, with taps about the middle.
ECHOLOOP_SIMD
void smooth(float* cube, std::size_t count, std::size_t stride, const float* taps) {
    constexpr std::size_t size = PatchNoise::size;
    float line[size + 2 * smoothing_reach], sum[size];
    for (std::size_t start = 0; start < count; ++start) {
        if (start / stride % size != 0) continue;
        for (std::size_t i = 0; i < size + 2 * smoothing_reach; ++i)
            line[i] = cube[start + (i + size - smoothing_reach) % size * stride];
        for (std::size_t i = 0; i < size; ++i) sum[i] = 0;
        for (std::size_t k = 0; k < smoothing_taps; ++k)
            for (std::size_t i = 0; i < size; ++i) sum[i] += taps[k] * line[i + k];
        for (std::size_t i = 0; i < size; ++i) cube[start + i * stride] = sum[i];
    }
}

}  // namespace

PatchNoise::PatchNoise() {
    std::vector<float> cube(all_cells + 1);
    for (std::size_t i = 0; i < cube.size(); ++i)
        cube[i] = static_cast<float>(static_cast<double>(mix(i, 0x9A7C) >> 11U) * 0x1p-53 - 0.5);
    // exp(-x^2 / (2 sigma^2)) with itself has the correlation exp(-x^2 / (4 sigma^2)).
    constexpr double sigma = length / 2;
    std::array<float, smoothing_taps> taps;
    for (std::size_t i = 0; i < smoothing_taps; ++i) {
        const int k = static_cast<int>(i) - static_cast<int>(smoothing_reach);
        taps[i] = static_cast<float>(std::exp(-k * k / (2 * sigma * sigma)));
    }
    for (const std::size_t stride : {1U, 64U, 64U * 64U})
        smooth(cube.data(), cube.size(), stride, taps.data());
    double mean = 0, square = 0;
    for (const float v : cube) mean += v, square += double{v} * v;
    mean /= static_cast<double>(cube.size());
    const double deviation = std::sqrt(square / static_cast<double>(cube.size()) - mean * mean);
    for (const float v : cube)
        values_.push_back(static_cast<std::int8_t>(
            std::clamp(std::round((v - mean) / deviation / double{scale}), -127.0, 127.0)));
}

const PatchNoise& PatchNoise::shared() {
    static const PatchNoise noise;
    return noise;
}

Patches::Patches(const Scene& scene) {
    for (const SceneSurface& surface : scene.surfaces()) {
        const Material& material = scene.materials()[surface.material];
        surfaces_.push_back(
            {static_cast<float>(material.patchiness * neper_per_db), key_of(material.name), 0});
        any_ |= material.patchiness > 0;
    }
    if (!any_) return;
    PatchNoise::shared();
    const auto movers = scene.movers();
    for (std::size_t m = 0; m < movers.size(); ++m)
        for (std::uint32_t n = movers[m].first_node; n < movers[m].last_node; ++n)
            for (std::size_t s = 0; s < surfaces_.size(); ++s)
                if (scene.surfaces()[s].object == scene.nodes()[n].object &&
                    scene.surfaces()[s].material == scene.nodes()[n].material)
                    surfaces_[s].frame = m + 1;
}

void Patches::place(const Pose& world_from_fan, std::span<const Pose> movers,
                    std::shared_ptr<const RayTable> rays) {
    rays_ = std::move(rays);
    world_from_fan_ = world_from_fan.orientation;
    frames_.clear();
    const auto add = [&](const Pose& from_fan) {
        Frame& frame = frames_.emplace_back();
        for (std::size_t scale = 0; scale < lengths_count; ++scale)
            frame[scale] = {in_cells(from_fan.position, scale), turn_of_scale(scale) * from_fan.orientation};
    };
    add(world_from_fan);
    for (const Pose& mover : movers) add(inverse(mover) * world_from_fan);
}

void Patches::find_stretches(const float* surface, std::size_t count, std::vector<Stretch>& out) const {
    out.clear();
    for (std::size_t first = 0, last = 0; first < count; first = last) {
        last = first + count_alike(surface + first, count - first);
        const auto number = static_cast<std::size_t>(surface[first]);
        if (number > 0 && number <= surfaces_.size() && surfaces_[number - 1].strength > 0)
            out.push_back({first, last, surfaces_[number - 1]});
    }
}

bool Patches::weigh(const PixelRow& row, const View& view, std::size_t line, PixelOffset offset,
                    const float* weight, std::vector<float>& out) const {
    static thread_local std::vector<float> noise, variance, share;
    static thread_local std::vector<std::uint32_t> cells;
    static thread_local std::vector<Stretch> stretches;
    const std::size_t count = view.samples;
    find_stretches(row.surface(), count, stretches);
    if (stretches.empty()) return false;
    noise.assign(count, 0.0F), variance.assign(count, 0.0F), share.resize(count), cells.resize(count);
    const double x = view.x(static_cast<double>(line) + 0.5 + offset.line);
    const LineShape shape{static_cast<float>(x * x), static_cast<float>(view.y(0.5 + offset.sample)),
                          static_cast<float>(view.sample_height())};
    const auto floats = [](Vec3 v) {
        return std::array{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    const std::int8_t* const table = PatchNoise::shared().values();
    const Quat fan_from_view = view.fan_from_view();
    static thread_local BentLine bent;
    if (rays_) bent.find(*rays_, world_from_fan_ * fan_from_view, x, shape, row.range(), count);
    for (std::size_t frame = 0; frame < frames_.size(); ++frame) {
        const auto is_of_frame = [frame](const Stretch& one) { return one.surface.frame == frame; };
        if (std::ranges::none_of(stretches, is_of_frame)) continue;
        for (std::size_t scale = 0; scale < lengths_count; ++scale) {
            const auto& [eye, cells_from_fan] = frames_[frame][scale];
            const Quat q = cells_from_fan * fan_from_view;
            const double per_cell = 1 / cell_of_scale(scale);
            const LineOfCells of{
                floats(eye),
                floats(per_cell * rotate(q, {1, -x, 0})),
                floats(per_cell * rotate(q, {0, 0, 1})),
                floats(per_cell * rotate(cells_from_fan * conjugate(world_from_fan_), {0, 0, 1})),
                static_cast<float>(view.usual_width * view.line_width() / lengths[scale]),
                static_cast<float>(view.usual_height * view.sample_height() / lengths[scale])};
            if (rays_)
                find_bent_cells(of, shape, row.range(), row.cosine(), bent.along.data(), bent.rise.data(),
                                count, cells.data(), share.data());
            else
                find_cells(of, shape, row.range(), row.cosine(), count, cells.data(), share.data());
            for (const Stretch& one : stretches)
                if (is_of_frame(one))
                    add_noise(table, one.surface.key, &cells[one.first], &share[one.first],
                              one.last - one.first, &noise[one.first], &variance[one.first]);
        }
    }
    out.resize(count);
    if (out.data() != weight) std::copy_n(weight, count, out.data());
    for (const Stretch& one : stretches)
        multiply_by_patches(&out[one.first], one.surface.strength, &noise[one.first], &variance[one.first],
                            one.last - one.first, &out[one.first]);
    return true;
}

double Patches::factor(const Material& material, Vec3 point) {
    double noise = 0;
    for (std::size_t scale = 0; scale < lengths_count; ++scale) {
        const Vec3 at = in_cells(point, scale);
        const auto cell = static_cast<std::uint32_t>(
            static_cast<int>(at.x) +
            PatchNoise::size * (static_cast<int>(at.y) + PatchNoise::size * static_cast<int>(at.z)));
        noise += std::sqrt(0.5) * double{PatchNoise::scale} *
                 PatchNoise::shared().at((cell + key_of(material.name)) & all_cells);
    }
    const double s = material.patchiness * neper_per_db;
    return std::exp(s * noise - s * s / 2);
}

}  // namespace echoloop
