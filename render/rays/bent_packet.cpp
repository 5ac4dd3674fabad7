#include "render/rays/bent_packet.h"

#include <algorithm>
#include <cmath>

#include "render/simd.h"

namespace echoloop::rays {
namespace {

constexpr unsigned nothing_met = ~0U;  ///< as Embree says

ECHOLOOP_INLINE Four load(const float* from) {
    Four out;
    __builtin_memcpy(&out, from, sizeof out);
    return out;
}
ECHOLOOP_INLINE void store(Four all, float* to) { __builtin_memcpy(to, &all, sizeof all); }

/// Whether a ray's sine of elevation is within `low`..`high`.
ECHOLOOP_SIMD
bool any_between(const ViewAxes axes, const float* __restrict x_of, const float* __restrict y_of,
                 const float low, const float high) {
    int any = 0;
    for (std::size_t i = 0; i < packet_rays; ++i) {
        const float x = x_of[i], y = y_of[i];
        const float dz = axes.starboard[2] * x + axes.up[2] * y + axes.forward[2];
        const float square = x * x + y * y + 1, signed_square = dz * std::abs(dz);
        any |=
            signed_square >= low * std::abs(low) * square && signed_square <= high * std::abs(high) * square
                ? 1
                : 0;
    }
    return any != 0;
}

ECHOLOOP_SIMD
void launch_all(const ViewAxes axes, const float* __restrict x_of, const float* __restrict y_of,
                float* __restrict ahead_x, float* __restrict ahead_y, float* __restrict rise,
                std::int32_t* __restrict row) {
    constexpr auto half = static_cast<float>(RayChains::half);
    const float sx = axes.starboard[0], sy = axes.starboard[1], sz = axes.starboard[2], ux = axes.up[0],
                uy = axes.up[1], uz = axes.up[2], fx = axes.forward[0], fy = axes.forward[1],
                fz = axes.forward[2];
    for (std::size_t i = 0; i < packet_rays; ++i) {
        const float x = x_of[i], y = y_of[i];
        const float dx = sx * x + ux * y + fx, dy = sy * x + uy * y + fy, dz = sz * x + uz * y + fz;
        const float level = std::sqrt(dx * dx + dy * dy), length = std::sqrt(x * x + y * y + 1);
        const float tangent = std::abs(dz) / (length + level);  // of half the elevation
        const auto off = static_cast<std::int32_t>(std::sqrt(tangent) * half + 0.5F);
        const float root = static_cast<float>(off) * (1 / half), of_row = root * root;
        const float sign = dz < 0 ? -1.0F : 1.0F;
        rise[i] = sign * 2 * (tangent - of_row) / (1 + tangent * of_row);
        row[i] = RayChains::half + static_cast<std::int32_t>(sign) * off;
        const float inverse = 1 / std::max(level, 1e-12F);
        ahead_x[i] = dx * inverse, ahead_y[i] = dy * inverse;
    }
}

/// Rays' chords are gathered one by one, in places `way` and `lengths` of four numbers each.
ECHOLOOP_SIMD
void gather_chords(const RayChains::Chord* chords, const std::int32_t* __restrict chord,
                   const float* __restrict rise, float* __restrict way, float* __restrict lengths) {
    for (std::size_t i = 0; i < packet_rays; ++i) {
        const RayChains::Chord& c = chords[chord[i]];
        store(load(c.way.data()) + rise[i] * load(c.way_slope.data()), way + 4 * i);
        store(load(&c.length), lengths + 4 * i);
    }
}

ECHOLOOP_SIMD
void place_chords(const float* __restrict way, const float* __restrict lengths,
                  const float* __restrict ahead_x, const float* __restrict ahead_y,
                  const float* __restrict from, const float eye_x, const float eye_y, const float eye_z,
                  const float reach, float* __restrict next, float* __restrict x, float* __restrict y,
                  float* __restrict z, float* __restrict to_x, float* __restrict to_y, float* __restrict to_z,
                  float* __restrict begin, float* __restrict end) {
    constexpr float overlap = 1.00001F;  // of neighbouring chords: none passes where they meet
    constexpr float longer = 1.01F;      // lengths and shares of a chord may grow unlike each other
    for (std::size_t i = 0; i < packet_rays; ++i) {
        const float off = way[4 * i], height = way[4 * i + 1], along = way[4 * i + 2], up = way[4 * i + 3];
        x[i] = eye_x + off * ahead_x[i], y[i] = eye_y + off * ahead_y[i], z[i] = eye_z + height;
        to_x[i] = along * ahead_x[i], to_y[i] = along * ahead_y[i], to_z[i] = up;
        const float length = lengths[4 * i], inverse_length = lengths[4 * i + 1];
        begin[i] = from[i];
        end[i] = std::min((reach - length) * longer * inverse_length, overlap);
        next[i] = lengths[4 * i + 2];
    }
}

ECHOLOOP_SIMD
std::uint32_t pass_on(const unsigned* __restrict met, const float reach, const float* __restrict next,
                      std::int32_t* __restrict chord, float* __restrict from, int* __restrict asked) {
    std::uint32_t hits = 0;
    for (std::size_t i = 0; i < packet_rays; ++i) {
        const int hit = met[i] != nothing_met ? -1 : 0, goes_on = next[i] < reach ? -1 : 0;
        const int was = asked[i];
        hits |= static_cast<std::uint32_t>(was & hit) & (1U << i);
        chord[i] -= was & ~hit & goes_on;
        from[i] = hit != 0 ? from[i] : 0.0F;
        asked[i] = was & (hit | goes_on);
    }
    return hits;
}

/// As gather_chords(). `share`, of the chord, becomes that of the arc.
ECHOLOOP_SIMD
void gather_arcs(const RayChains::Chord* chords, const RayChains::Arc* arcs,
                 const std::int32_t* __restrict chord, const float* __restrict rise, int count,
                 float* __restrict share, float* __restrict above, float* __restrict turn,
                 float* __restrict spread) {
    for (int i = 0; i < count; ++i) {
        const RayChains::Chord& c = chords[chord[i]];
        const RayChains::Arc* arc = arcs + c.arc;
        if (share[i] > c.second_arc + rise[i] * c.second_arc_slope) {
            ++arc;
            while (arc[1].part[0] > 0 && share[i] > arc[1].part[0] + rise[i] * arc[1].part_slope[0]) ++arc;
        }
        const Four part = load(arc->part.data()) + rise[i] * load(arc->part_slope.data());
        const float own = (share[i] - part[0]) * part[1];
        share[i] = own, above[i] = part[2] + own * part[3];
        store(load(arc->turn.data()) + rise[i] * load(arc->turn_slope.data()), turn + 4 * i);
        store(load(arc->spread.data()) + own * load(arc->spread_growth.data()), spread + 4 * i);
    }
}

/// Of angles below a radian, by their series.
ECHOLOOP_INLINE float sine_of(float angle) {
    const float q = angle * angle;
    return angle * (1 - q * (1 / 6.0F - q * (1 / 120.0F)));
}
ECHOLOOP_INLINE float cosine_of(float angle) {
    const float q = angle * angle;
    return 1 - q * (0.5F - q * (1 / 24.0F - q * (1 / 720.0F)));
}

ECHOLOOP_SIMD
void straighten_all(const ViewAxes axes, const float x_image, const float* __restrict y_of,
                    const float* __restrict above, const float* __restrict turn,
                    const float* __restrict spread, int count, float* __restrict depth,
                    float* __restrict px_of, float* __restrict py_of, float* __restrict pz_of,
                    float* __restrict nx_of, float* __restrict ny_of, float* __restrict nz_of) {
    for (int i = 0; i < count; ++i) {
        const float y = y_of[i], share = depth[i];
        const float dx = axes.starboard[0] * x_image + axes.up[0] * y + axes.forward[0],
                    dy = axes.starboard[1] * x_image + axes.up[1] * y + axes.forward[1],
                    dz = axes.starboard[2] * x_image + axes.up[2] * y + axes.forward[2];
        const float level = std::sqrt(dx * dx + dy * dy), unit = 1 / std::sqrt(x_image * x_image + y * y + 1);
        const float inverse = 1 / std::max(level, 1e-12F), ahead_x = dx * inverse, ahead_y = dy * inverse;
        const float cosine = level * unit, sine = dz * unit;
        const float bow_begin = turn[4 * i], more_bow = turn[4 * i + 1], length_begin = turn[4 * i + 2],
                    own_length = turn[4 * i + 3];
        const float width = spread[4 * i], beside = spread[4 * i + 1], speed = spread[4 * i + 2],
                    uneven = spread[4 * i + 3];
        const float bow = bow_begin + share * more_bow, s = sine_of(bow), c = cosine_of(bow);
        const float ray_cosine = cosine * c - sine * s, ray_sine = sine * c + cosine * s;
        const float rest = share * (1 - share), chord = own_length * speed;
        const float sag = 0.5F * chord * more_bow * rest - above[i];

        const float p_ahead = px_of[i] * ahead_x + py_of[i] * ahead_y,
                    p_beside = py_of[i] * ahead_x - px_of[i] * ahead_y, p_up = pz_of[i];
        const float p_ray = p_ahead * ray_cosine + p_up * ray_sine,
                    p_across = p_up * ray_cosine - p_ahead * ray_sine;
        constexpr float most_slip = 16;
        const float wide = most_slip * std::abs(sag);
        const float slip = std::min(std::max(sag * p_across / (p_ray * speed), -wide), wide);
        // Time goes faster where sound is slower.
        const float length = length_begin + own_length * (share + uneven * rest) + slip;
        const float q_ray = p_ray * speed, q_across = p_across * width / length, q_beside = p_beside * beside;
        const float q_ahead = q_ray * cosine - q_across * sine;
        px_of[i] = q_ahead * ahead_x - q_beside * ahead_y;
        py_of[i] = q_ahead * ahead_y + q_beside * ahead_x;
        pz_of[i] = q_ray * sine + q_across * cosine;

        // The direction where the arc, not the chord, meets the plane.
        const float bow_there = bow + more_bow * std::min(std::max(slip / own_length, -1.0F), 1.0F),
                    turn_s = sine_of(bow_there), turn_c = cosine_of(bow_there);
        const float n_ahead = nx_of[i] * ahead_x + ny_of[i] * ahead_y, n_up = nz_of[i];
        const float turned = n_ahead * (turn_c - 1) + n_up * turn_s;
        nx_of[i] += turned * ahead_x, ny_of[i] += turned * ahead_y;
        nz_of[i] = n_up * turn_c - n_ahead * turn_s;
        depth[i] = length * unit;
    }
}

}  // namespace

bool all_straight(const ViewAxes& axes, const float* x, const float* y, const RayChains& chains) {
    return !any_between(axes, x, y, chains.lowest_bent(), chains.highest_bent());
}

void launch(const ViewAxes& axes, const float* x, const float* y, const RayChains& chains, float near,
            BentRays& rays) {
    launch_all(axes, x, y, rays.ahead_x.data(), rays.ahead_y.data(), rays.rise.data(), rays.chord.data());
    for (std::size_t lane = 0; lane < packet_rays; ++lane) {
        const RayChains::Row row = *chains.row(rays.chord[lane]);
        rays.chord[lane] = row.first, rays.from[lane] = near * row.inverse_length;
    }
}

void find_chords(const RayChains& chains, std::span<BentRays* const> rays, const float* eye, float reach,
                 const Chords* to) {
    // What is written one by one is not read in vectors right after.
    alignas(64) std::array<float, 4 * packet_rays> way[most_tiles], lengths[most_tiles];
    for (std::size_t i = 0; i < rays.size(); ++i)
        gather_chords(chains.chords(), rays[i]->chord.data(), rays[i]->rise.data(), way[i].data(),
                      lengths[i].data());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        BentRays& r = *rays[i];
        const Chords& out = to[i];
        place_chords(way[i].data(), lengths[i].data(), r.ahead_x.data(), r.ahead_y.data(), r.from.data(),
                     eye[0], eye[1], eye[2], reach, r.next.data(), out.x, out.y, out.z, out.to_x, out.to_y,
                     out.to_z, out.begin, out.end);
    }
}

std::uint32_t go_on(const unsigned* met, float reach, BentRays& rays, int* asked) {
    return pass_on(met, reach, rays.next.data(), rays.chord.data(), rays.from.data(), asked);
}

void straighten(const ViewAxes& axes, const RayChains& chains, float x, const float* y, const BentHits& bent,
                std::size_t first, std::size_t last, HitArrays& hits) {
    if (first >= last) return;
    const auto from = [first](auto& all) { return all.data() + first; };
    const auto count = static_cast<int>(last - first);
    alignas(64) std::array<float, 4 * HitArrays::most> turn, spread;
    alignas(64) HitArrays::Numbers above;
    gather_arcs(chains.chords(), chains.arcs(), from(bent.chord), from(bent.rise), count, from(hits.depth),
                above.data(), turn.data(), spread.data());
    straighten_all(axes, x, y + first, above.data(), turn.data(), spread.data(), count, from(hits.depth),
                   from(hits.plane_x), from(hits.plane_y), from(hits.plane_z), from(hits.normal_x),
                   from(hits.normal_y), from(hits.normal_z));
}

}  // namespace echoloop::rays
