#include "render/rays/bent_tracer.h"

#include <algorithm>
#include <cmath>

namespace echoloop::rays {

BentTracer::BentTracer(const ViewPlace& place, std::size_t samples, const TracedParts& parts,
                       const RayChains& chains, float reach)
    : place_(place), samples_(samples), parts_(parts), chains_(chains), reach_(reach) {
    for (Tile& tile : tiles_)
        for (std::size_t lane = 0; lane < packet_rays; ++lane)
            tile.query.ray.time[lane] = 0, tile.query.ray.mask[lane] = ~0U, tile.query.ray.flags[lane] = 0;
}

void BentTracer::trace(std::span<const TracedLine> lines) {
    for (std::size_t lane = 0; lane < packet_rays; ++lane)
        x_[lane] = lines[std::min(lane / tile_samples, lines.size() - 1)].x;
    for (std::size_t sample = 0; sample < samples_; sample += HitArrays::most) {
        const std::size_t count = std::min(HitArrays::most, samples_ - sample);
        for (std::size_t line = 0; line < lines.size(); ++line) {
            hits_[line].surface.fill(0), hits_[line].depth.fill(0);
            bent_[line].rise.fill(0), bent_[line].place.fill(0);
        }
        const auto tiles = std::span(tiles_).first((count + tile_samples - 1) / tile_samples);
        for (std::size_t i = 0; i < tiles.size(); ++i)
            start(tiles[i], sample + i * tile_samples, lines.size());
        // Straight rays in front of all others and behind them are followed as such.
        std::size_t first = 0, last = tiles.size();
        while (first < last && tiles[first].straight) ++first;
        while (first < last && tiles[last - 1].straight) --last;
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            tiles[i].straight = i < first || i >= last;
            if (tiles[i].straight) tiles[i].rays.from.fill(near_end);
        }
        for (bool any = true; any;) {
            for (std::size_t i = 0; i < tiles.size(); ++i)
                if (tiles[i].any)
                    tiles[i].straight ? aim_straight(tiles[i], sample + i * tile_samples) : aim(tiles[i]);
            for (Tile& tile : tiles)
                if (tile.any) first_hits(tile.asked.data(), parts_.scene(), tile.query);
            any = false;
            for (std::size_t i = 0; i < tiles.size(); ++i)
                if (tiles[i].any) take_hits(tiles[i], i), any |= tiles[i].any;
        }
        for (std::size_t line = 0; line < lines.size(); ++line) {
            straighten(place_.axes, chains_, lines[line].x, &place_.y[sample], bent_[line],
                       first * tile_samples, std::min(last * tile_samples, count), hits_[line]);
            find_pixels(place_.axes, place_.sizes, lines[line].x, &place_.y[sample], hits_[line], count,
                        lines[line].pixels + sample);
        }
    }
}

void BentTracer::start(Tile& tile, std::size_t sample, std::size_t lines) {
    std::array<float, packet_rays> y;
    for (std::size_t lane = 0; lane < packet_rays; ++lane) y[lane] = place_.y[sample + lane % tile_samples];
    tile.straight = !launch(place_.axes, x_.data(), y.data(), chains_, near_end, tile.rays);
    for (std::size_t lane = 0; lane < packet_rays; ++lane)
        tile.asked[lane] = lane / tile_samples < lines && sample + lane % tile_samples < samples_ ? -1 : 0;
    tile.any = true;
}

void BentTracer::aim(Tile& tile) const {
    RTCRay16& ray = tile.query.ray;
    find_chords(chains_, tile.rays, place_.eye.data(), reach_,
                {ray.org_x, ray.org_y, ray.org_z, ray.dir_x, ray.dir_y, ray.dir_z, tile.end.data()});
    constexpr float overlap = 1.00001F;  // of neighbouring chords: none passes where they meet
    for (std::size_t lane = 0; lane < packet_rays; ++lane) {
        ray.tnear[lane] = tile.rays.from[lane], ray.tfar[lane] = std::min(overlap, tile.end[lane]);
        tile.query.hit.geomID[lane] = tile.query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
}

void BentTracer::aim_straight(Tile& tile, std::size_t sample) const {
    RTCRay16& ray = tile.query.ray;
    std::array<float, packet_rays> y;
    for (std::size_t lane = 0; lane < packet_rays; ++lane) y[lane] = place_.y[sample + lane % tile_samples];
    find_directions(place_.axes, x_.data(), y.data(), ray.dir_x, ray.dir_y, ray.dir_z);
    for (std::size_t lane = 0; lane < packet_rays; ++lane) {
        ray.org_x[lane] = place_.eye[0], ray.org_y[lane] = place_.eye[1], ray.org_z[lane] = place_.eye[2];
        ray.tnear[lane] = tile.rays.from[lane];
        ray.tfar[lane] = reach_ / std::sqrt(x_[lane] * x_[lane] + y[lane] * y[lane] + 1);
        tile.query.hit.geomID[lane] = tile.query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
}

void BentTracer::take_hits(Tile& tile, std::size_t number) {
    tile.any = false;
    for (std::size_t lane = 0; lane < packet_rays; ++lane) {
        if (tile.asked[lane] == 0) continue;
        const std::size_t line = lane / tile_samples, at = number * tile_samples + lane % tile_samples;
        if (tile.query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) {
            go_on(tile, lane);
        } else if (parts_.take_hit(tile.query, lane, hits_[line], at)) {
            bent_[line].rise[at] = tile.rays.rise[lane], bent_[line].place[at] = tile.rays.place[lane];
            tile.asked[lane] = 0;
        } else {  // what is not there from behind is passed
            const RTCRay16& ray = tile.query.ray;
            const float square = ray.dir_x[lane] * ray.dir_x[lane] + ray.dir_y[lane] * ray.dir_y[lane] +
                                 ray.dir_z[lane] * ray.dir_z[lane];
            tile.rays.from[lane] = ray.tfar[lane] * (1 + 1e-6F) + 1e-5F / std::sqrt(square);
        }
        tile.any |= tile.asked[lane] != 0;
    }
}

/// To the next chord, if there is one.
void BentTracer::go_on(Tile& tile, std::size_t lane) const {
    const auto next = static_cast<std::size_t>(++tile.rays.place[lane]);
    const std::vector<float>& length = chains_.places().length;
    tile.rays.from[lane] = 0;
    if (tile.straight || length[next] >= reach_ || length[next + 1] == 0)
        tile.asked[lane] = 0, --tile.rays.place[lane];
}

}  // namespace echoloop::rays
