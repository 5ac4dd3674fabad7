#include "render/rays/bent_packet.h"

#include <algorithm>
#include <cmath>

#include "render/simd.h"

namespace echoloop::rays {
namespace {

/// The arrays of RayChains::Places.
struct PlaceArrays {
    const float *length, *length_slope, *x, *x_slope, *z, *z_slope, *bow, *bow_slope, *width, *beside, *speed;
};

PlaceArrays place_arrays(const RayChains& chains) {
    const RayChains::Places& p = chains.places();
    return {p.length.data(), p.length_slope.data(), p.x.data(),    p.x_slope.data(),
            p.z.data(),      p.z_slope.data(),      p.bow.data(),  p.bow_slope.data(),
            p.width.data(),  p.beside.data(),       p.speed.data()};
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

ECHOLOOP_SIMD
void find_all_chords(const PlaceArrays places, const float* __restrict ahead_x,
                     const float* __restrict ahead_y, const float* __restrict rise_of,
                     const std::int32_t* __restrict place, const float eye_x, const float eye_y,
                     const float eye_z, const float reach, float* __restrict x, float* __restrict y,
                     float* __restrict z, float* __restrict to_x, float* __restrict to_y,
                     float* __restrict to_z, float* __restrict end) {
    for (std::size_t i = 0; i < packet_rays; ++i) {
        const std::int32_t a = place[i], b = a + 1;
        const float rise = rise_of[i];
        const float from = places.x[a] + rise * places.x_slope[a],
                    height = places.z[a] + rise * places.z_slope[a];
        const float along = places.x[b] + rise * places.x_slope[b] - from,
                    up = places.z[b] + rise * places.z_slope[b] - height;
        x[i] = eye_x + from * ahead_x[i], y[i] = eye_y + from * ahead_y[i], z[i] = eye_z + height;
        to_x[i] = along * ahead_x[i], to_y[i] = along * ahead_y[i], to_z[i] = up;
        const float length = places.length[b] - places.length[a];
        end[i] = length > 0 ? (reach - places.length[a]) / length : 0;
    }
}

ECHOLOOP_SIMD
void straighten_all(const ViewAxes axes, const PlaceArrays places, const float x_image,
                    const float* __restrict y_of, const float* __restrict rise_of,
                    const std::int32_t* __restrict place, int count, float* __restrict depth,
                    float* __restrict px_of, float* __restrict py_of, float* __restrict pz_of,
                    float* __restrict nx_of, float* __restrict ny_of, float* __restrict nz_of) {
    for (int i = 0; i < count; ++i) {
        const float y = y_of[i], rise = rise_of[i], share = depth[i];
        const std::int32_t a = place[i], b = a + 1;
        const float dx = axes.starboard[0] * x_image + axes.up[0] * y + axes.forward[0],
                    dy = axes.starboard[1] * x_image + axes.up[1] * y + axes.forward[1],
                    dz = axes.starboard[2] * x_image + axes.up[2] * y + axes.forward[2];
        const float level = std::sqrt(dx * dx + dy * dy), unit = 1 / std::sqrt(x_image * x_image + y * y + 1);
        const float ahead_x = dx / std::max(level, 1e-12F), ahead_y = dy / std::max(level, 1e-12F);
        const float cosine = level * unit, sine = dz * unit;
        const auto at = [&](const float* all, const float* slope, std::int32_t k) {
            return all[k] + rise * slope[k];
        };
        const float bow_a = at(places.bow, places.bow_slope, a), bow_b = at(places.bow, places.bow_slope, b);
        const float length_a = at(places.length, places.length_slope, a),
                    length_b = at(places.length, places.length_slope, b);
        const auto between = [&](const float* all) { return all[a] + share * (all[b] - all[a]); };
        const float bow = bow_a + share * (bow_b - bow_a), q = bow * bow;
        const float s = bow * (1 - q * (1 / 6.0F - q * (1 / 120.0F))),
                    c = 1 - q * (0.5F - q * (1 / 24.0F - q * (1 / 720.0F)));
        const float ray_cosine = cosine * c - sine * s, ray_sine = sine * c + cosine * s;
        const float width = between(places.width), beside = between(places.beside);
        const float speed_a = places.speed[a], speed_b = places.speed[b],
                    speed = speed_a + share * (speed_b - speed_a);
        const float rest = share * (1 - share), chord = (length_b - length_a) * speed;
        const float sag = 0.5F * chord * (bow_b - bow_a) * rest;

        const float p_ahead = px_of[i] * ahead_x + py_of[i] * ahead_y,
                    p_beside = py_of[i] * ahead_x - px_of[i] * ahead_y, p_up = pz_of[i];
        const float p_ray = p_ahead * ray_cosine + p_up * ray_sine,
                    p_across = p_up * ray_cosine - p_ahead * ray_sine;
        constexpr float most_slip = 16;
        const float wide = most_slip * std::abs(sag);
        const float slip = std::min(std::max(sag * p_across / p_ray, -wide), wide);
        // Time goes faster where sound is slower.
        const float uneven = (speed_b - speed_a) / (speed_a + speed_b);
        const float length = length_a + (length_b - length_a) * (share + uneven * rest) + slip / speed;
        const float q_ray = p_ray * speed, q_across = p_across * width / length, q_beside = p_beside * beside;
        const float q_ahead = q_ray * cosine - q_across * sine;
        px_of[i] = q_ahead * ahead_x - q_beside * ahead_y;
        py_of[i] = q_ahead * ahead_y + q_beside * ahead_x;
        pz_of[i] = q_ray * sine + q_across * cosine;

        const float n_ahead = nx_of[i] * ahead_x + ny_of[i] * ahead_y, n_up = nz_of[i];
        const float turned = n_ahead * (c - 1) + n_up * s;
        nx_of[i] += turned * ahead_x, ny_of[i] += turned * ahead_y;
        nz_of[i] = n_up * c - n_ahead * s;
        depth[i] = length * unit;
    }
}

}  // namespace

bool launch(const ViewAxes& axes, const float* x, const float* y, const RayChains& chains, float near,
            BentRays& rays) {
    launch_all(axes, x, y, rays.ahead_x.data(), rays.ahead_y.data(), rays.rise.data(), rays.place.data());
    std::int32_t bends = 0;
    for (std::size_t lane = 0; lane < packet_rays; ++lane) {
        const RayChains::Row row = *chains.row(rays.place[lane]);
        rays.place[lane] = row.first, rays.from[lane] = near * row.inverse_length;
        bends |= row.bends;
    }
    return bends != 0;
}

void find_chords(const RayChains& chains, const BentRays& rays, const float* eye, float reach,
                 const Chords& to) {
    find_all_chords(place_arrays(chains), rays.ahead_x.data(), rays.ahead_y.data(), rays.rise.data(),
                    rays.place.data(), eye[0], eye[1], eye[2], reach, to.x, to.y, to.z, to.to_x, to.to_y,
                    to.to_z, to.end);
}

void straighten(const ViewAxes& axes, const RayChains& chains, float x, const float* y, const BentHits& bent,
                std::size_t first, std::size_t last, HitArrays& hits) {
    const auto from = [first](auto& all) { return all.data() + first; };
    straighten_all(axes, place_arrays(chains), x, y + first, from(bent.rise), from(bent.place),
                   static_cast<int>(last - first), from(hits.depth), from(hits.plane_x), from(hits.plane_y),
                   from(hits.plane_z), from(hits.normal_x), from(hits.normal_y), from(hits.normal_z));
}

}  // namespace echoloop::rays
