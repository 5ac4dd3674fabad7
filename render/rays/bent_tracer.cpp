#include "render/rays/bent_tracer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace echoloop::rays {

BentTracer::BentTracer(const ViewPlace& place, std::size_t samples, const TracedParts& parts,
                       const RayChains& chains, float reach)
    : place_(place), samples_(samples), parts_(parts), chains_(chains), reach_(reach) {
    for (Tile& tile : tiles_) {
        tile.rays = {};  // straight ones keep what was there
        for (std::size_t lane = 0; lane < packet_rays; ++lane)
            tile.query.ray.time[lane] = 0, tile.query.ray.mask[lane] = ~0U, tile.query.ray.flags[lane] = 0;
    }
}

void BentTracer::trace(std::span<const TracedLine> lines) {
    for (std::size_t lane = 0; lane < packet_rays; ++lane)
        x_[lane] = lines[std::min(lane / tile_samples, lines.size() - 1)].x;
    for (std::size_t sample = 0; sample < samples_; sample += HitArrays::most) {
        const std::size_t count = std::min(HitArrays::most, samples_ - sample);
        const auto tiles = std::span(tiles_).first((count + tile_samples - 1) / tile_samples);
        for (std::size_t i = 0; i < tiles.size(); ++i) start(tiles[i], i, sample, lines.size());
        // Straight rays in front of all others and behind them are followed as such.
        for (Tile& tile : tiles) tile.straight = all_straight(place_.axes, x_.data(), tile.y.data(), chains_);
        std::size_t first = 0, last = tiles.size();
        while (first < last && tiles[first].straight) ++first;
        while (first < last && tiles[last - 1].straight) --last;
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            tiles[i].straight = i < first || i >= last;
            if (tiles[i].straight)
                tiles[i].rays.from.fill(near_end);
            else
                launch(place_.axes, x_.data(), tiles[i].y.data(), chains_, near_end, tiles[i].rays);
        }
        for (bool any = true; any;) {
            aim(tiles);
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

void BentTracer::start(Tile& tile, std::size_t number, std::size_t sample, std::size_t lines) {
    const std::size_t first = sample + number * tile_samples;
    for (std::size_t lane = 0; lane < packet_rays; ++lane)
        tile.y[lane] = place_.y[first + lane % tile_samples];
    for (std::size_t lane = 0; lane < packet_rays; ++lane)
        tile.asked[lane] = lane / tile_samples < lines && first + lane % tile_samples < samples_ ? -1 : 0;
    tile.any = true;
    for (HitArrays& hits : hits_) std::fill_n(&hits.surface[number * tile_samples], tile_samples, 0.0F);
}

void BentTracer::aim(std::span<Tile> tiles) {
    std::array<BentRays*, tiles_at_once> bent;
    std::array<Chords, tiles_at_once> chords;
    std::size_t count = 0;
    for (Tile& tile : tiles) {
        if (!tile.any) continue;
        RTCRayHit16& query = tile.query;
        std::fill_n(query.hit.geomID, packet_rays, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(query.hit.instID[0], packet_rays, RTC_INVALID_GEOMETRY_ID);
        RTCRay16& ray = query.ray;
        if (tile.straight) {
            aim_straight(tile);
            continue;
        }
        bent[count] = &tile.rays;
        chords[count++] = {ray.org_x, ray.org_y, ray.org_z, ray.dir_x,
                           ray.dir_y, ray.dir_z, ray.tnear, ray.tfar};
    }
    find_chords(chains_, std::span(bent).first(count), place_.eye.data(), reach_, chords.data());
}

void BentTracer::aim_straight(Tile& tile) const {
    RTCRay16& ray = tile.query.ray;
    const std::array<float, packet_rays>& y = tile.y;
    find_directions(place_.axes, x_.data(), y.data(), ray.dir_x, ray.dir_y, ray.dir_z);
    for (std::size_t lane = 0; lane < packet_rays; ++lane) {
        ray.org_x[lane] = place_.eye[0], ray.org_y[lane] = place_.eye[1], ray.org_z[lane] = place_.eye[2];
        ray.tnear[lane] = tile.rays.from[lane];
        ray.tfar[lane] = reach_ / std::sqrt(x_[lane] * x_[lane] + y[lane] * y[lane] + 1);
    }
    tile.rays.next.fill(std::numeric_limits<float>::infinity());
}

void BentTracer::take_hits(Tile& tile, std::size_t number) {
    std::uint32_t hits = go_on(tile.query.hit.geomID, reach_, tile.rays, tile.asked.data());
    for (; hits != 0; hits &= hits - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(hits));
        const std::size_t line = lane / tile_samples, at = number * tile_samples + lane % tile_samples;
        if (parts_.take_hit(tile.query, lane, hits_[line], at)) {
            bent_[line].rise[at] = tile.rays.rise[lane], bent_[line].chord[at] = tile.rays.chord[lane];
            tile.asked[lane] = 0;
        } else {  // what is not there from behind is passed
            const RTCRay16& ray = tile.query.ray;
            const float square = ray.dir_x[lane] * ray.dir_x[lane] + ray.dir_y[lane] * ray.dir_y[lane] +
                                 ray.dir_z[lane] * ray.dir_z[lane];
            tile.rays.from[lane] = ray.tfar[lane] * (1 + 1e-6F) + 1e-5F / std::sqrt(square);
        }
    }
    int any = 0;
    for (const int asked : tile.asked) any |= asked;
    tile.any = any != 0;
}

}  // namespace echoloop::rays
