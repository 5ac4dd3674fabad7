#include "render/scene/contraction.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace echoloop {
namespace {

/// Of a triangle's normal before and after: beyond, it counts as turned over.
constexpr double least_cosine = 0.2;
/// Of an edge's length, on top of its cost: so that triangles on a plane grow alike.
constexpr double evenness = 1e-5;
constexpr float cheapest = 1e-9F;  ///< m; costs below it are alike
/// Triangles around two places that may be merged: each merger looks at all of them, so a fan of a hundred
/// thousand about one place would take minutes.
constexpr std::size_t most_around = 256;

bool has(const std::array<std::uint32_t, 3>& corners, std::uint32_t place) {
    return corners[0] == place || corners[1] == place || corners[2] == place;
}

}  // namespace

Contraction::Contraction(const Clusters& clusters)
    : places_(clusters.places()), parent_(clusters.places()), left_(clusters.triangles().size(), true) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    for (std::size_t i = 0; i < places_.size(); ++i) {
        places_[i].merged = clusters.place(i);
        places_[i].position = places_[i].merged.position();
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    edges.reserve(3 * left_.size());
    for (const MergedTriangle& triangle : clusters.triangles()) {
        const auto t = static_cast<std::uint32_t>(corners_.size());
        auto& corners = corners_.emplace_back(triangle.corners);
        for (std::uint32_t& corner : corners) corner = clusters.place_of(corner);
        for (std::size_t k = 0; k < 3; ++k) {
            places_[corners[k]].around.push_back(t);
            edges.push_back(std::minmax(corners[k], corners[(k + 1) % 3]));
        }
    }
    for (Place& place : places_) place.left = place.around.size();
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [a, b] : edges) propose(a, b);
}

/// Of a float's bits the exponent and three more: eight buckets for each doubling of the cost.
void Contraction::Queue::push(const Merger& merger) {
    constexpr unsigned dropped = 20;
    const std::size_t bucket = std::bit_cast<std::uint32_t>(std::max(merger.cost, cheapest)) >> dropped;
    if (buckets_.size() <= bucket) buckets_.resize(bucket + 1);
    buckets_[bucket].mergers.push_back(merger);
    cheapest_ = std::min(cheapest_, bucket);
}

Contraction::Merger Contraction::Queue::pop() {
    least_cost();
    Bucket& bucket = buckets_[cheapest_];
    return bucket.mergers[bucket.next++];
}

double Contraction::Queue::least_cost() {
    for (; cheapest_ < buckets_.size(); ++cheapest_) {
        Bucket& bucket = buckets_[cheapest_];
        if (bucket.next < bucket.mergers.size()) return static_cast<double>(bucket.mergers[bucket.next].cost);
        bucket = {};
    }
    return std::numeric_limits<double>::infinity();
}

void Contraction::propose(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    MergedPlace both = places_[a].merged;
    both.add(places_[b].merged);
    const double cost = both.error(both.position()) + evenness * length(a, b);
    mergers_.push({static_cast<float>(cost), a, b, ages_of(a, b)});
}

bool Contraction::is_current(const Merger& m) const {
    return parent_[m.a] == m.a && parent_[m.b] == m.b && ages_of(m.a, m.b) == (m.ages & ~forced);
}

/// Whether too many triangles meet at one of the places.
bool Contraction::is_hub(const Merger& m) const {
    return places_[m.a].left + places_[m.b].left > most_around;
}

/// Whether a triangle at one of two places that move together turns over.
bool Contraction::turns_over(std::uint32_t moved, std::uint32_t other, Vec3 to) const {
    for (const std::uint32_t t : places_[moved].around) {
        if (!left_[t] || has(corners_[t], other)) continue;
        Vec3 before[3], after[3];
        for (std::size_t k = 0; k < 3; ++k) {
            before[k] = places_[corners_[t][k]].position;
            after[k] = corners_[t][k] == moved ? to : before[k];
        }
        const Vec3 was = cross(before[1] - before[0], before[2] - before[0]),
                   is = cross(after[1] - after[0], after[2] - after[0]);
        if (!(dot(was, is) > least_cosine * norm(was) * norm(is))) return true;
    }
    return false;
}

void Contraction::merge(std::uint32_t a, std::uint32_t b, Vec3 position) {
    Place &into = places_[a], &from = places_[b];
    parent_[b] = a;
    into.merged.add(from.merged);
    into.position = position;
    ++into.age;
    for (const std::uint32_t t : from.around) {
        if (!left_[t]) continue;
        auto& corners = corners_[t];
        if (has(corners, a)) {
            left_[t] = false;
            for (const std::uint32_t corner : corners) --places_[corner].left;
            continue;
        }
        std::ranges::replace(corners, b, a);
        into.around.push_back(t);
        ++into.left;
    }
    from.around = {};
    std::erase_if(into.around, [&](std::uint32_t t) { return !left_[t]; });
}

void Contraction::propose_around(std::uint32_t a) {
    neighbours_.clear();
    for (const std::uint32_t t : places_[a].around)
        for (const std::uint32_t place : corners_[t])
            if (place != a) neighbours_.push_back(place);
    std::ranges::sort(neighbours_);
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
    for (const std::uint32_t place : neighbours_) propose(a, place);
}

/// Mergers that turn triangles over wait until the limit is as large as what moves; those at hubs, until
/// mergers around them have left less there.
void Contraction::until(double limit) {
    while (mergers_.least_cost() <= limit) {
        Merger m = mergers_.pop();
        if (!is_current(m)) continue;
        if (is_hub(m)) {
            m.cost = 2 * std::max(m.cost, cheapest);
            mergers_.push(m);
            continue;
        }
        MergedPlace both = places_[m.a].merged;
        both.add(places_[m.b].merged);
        const Vec3 to = both.position();
        if (m.ages < forced && (turns_over(m.a, m.b, to) || turns_over(m.b, m.a, to))) {
            m.cost = std::max(m.cost, static_cast<float>(length(m.a, m.b)));
            m.ages |= forced;
            mergers_.push(m);
            continue;
        }
        merge(m.a, m.b, to);
        propose_around(m.a);
    }
}

std::vector<std::uint32_t> Contraction::into() const {
    std::vector<std::uint32_t> out;
    out.reserve(places_.size());
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < parent_.size(); ++i)
        out.push_back(parent_[i] == i ? next++ : out[parent_[i]]);  // merged into one of a lower number
    return out;
}

}  // namespace echoloop
