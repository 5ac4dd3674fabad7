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
    : middle_(clusters.middle()),
      places_(clusters.places()),
      ages_(clusters.places()),
      parent_(clusters.places()),
      left_(clusters.triangles().size(), 1),
      loops_(clusters.places()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    positions_.resize(places_.size());
    loops_.each(places_.size(), [&](std::size_t i) {
        places_[i].merged = clusters.place(i);
        positions_[i] = places_[i].merged.position();
    });
    list_shades(clusters);
    list_triangles(clusters);
    find_homes();
    in_pieces([&](std::uint8_t piece) {
        const std::size_t first = std::size_t{piece} * places_a_piece_;
        for (std::size_t i = first; i < std::min(first + places_a_piece_, places_.size()); ++i)
            propose_around(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i), piece);
    });
}

void Contraction::find_homes() {
    constexpr std::size_t worth_pieces = 20'000;
    const std::size_t pieces = places_.size() < worth_pieces ? 1 : most_pieces;
    places_a_piece_ = static_cast<std::uint32_t>(places_.size() / pieces + 1);
    home_.resize(places_.size());
    for (std::uint32_t i = 0; i < places_.size(); ++i) home_[i] = piece_of(i);
    for (const auto& corners : corners_) {
        const std::uint8_t piece = piece_of(corners[0]);
        if (piece == piece_of(corners[1]) && piece == piece_of(corners[2])) continue;
        for (const std::uint32_t corner : corners) home_[corner] = shared;
    }
}

template <typename Work>
void Contraction::in_pieces(const Work& work) {
    loops_.parts(most_pieces, [&](std::size_t piece) { work(static_cast<std::uint8_t>(piece)); });
    for (Piece& piece : pieces_)
        for (const Merger& merger : std::exchange(piece.across, {})) pieces_[shared].mergers.push(merger);
}

void Contraction::push(const Merger& merger, std::uint8_t from) {
    const std::uint8_t home = home_of(merger);
    if (home == from || from == shared)
        pieces_[home].mergers.push(merger);
    else
        pieces_[from].across.push_back(merger);
}

double Contraction::next_error() {
    double least = std::numeric_limits<double>::infinity();
    for (Piece& piece : pieces_) least = std::min(least, piece.mergers.least_cost());
    return least;
}

void Contraction::list_shades(const Clusters& clusters) {
    shades_.reserve(clusters.vertices());
    for (std::uint32_t vertex = 0; vertex < clusters.vertices(); ++vertex) {
        std::uint32_t& first = places_[clusters.place_of(vertex)].first_shade;
        shades_.push_back({clusters.normals(vertex), clusters.side_of(vertex), first});
        first = vertex;
    }
}

void Contraction::list_triangles(const Clusters& clusters) {
    corners_.reserve(left_.size());
    sides_.reserve(left_.size());
    for (const MergedTriangle& triangle : clusters.triangles()) {
        auto& corners = corners_.emplace_back(triangle.corners);
        auto& sides = sides_.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            sides[k] = static_cast<std::uint8_t>(clusters.side_of(corners[k]));
            ++places_[corners[k] = clusters.place_of(corners[k])].left;
        }
    }
    for (Place& place : places_) place.around.reserve(place.left);
    for (std::uint32_t t = 0; t < corners_.size(); ++t)
        for (const std::uint32_t corner : corners_[t]) places_[corner].around.push_back(t);
}

std::uint32_t Contraction::shade_at(std::uint32_t place, std::uint32_t side) const {
    std::uint32_t shade = places_[place].first_shade;
    while (shade != none && shades_[shade].side != side) shade = shades_[shade].next;
    return shade;
}

std::uint32_t Contraction::vertex(std::size_t triangle, std::size_t corner) const {
    return shade_at(corners_[triangle][corner], sides_[triangle][corner]);
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

void Contraction::propose(std::uint32_t a, std::uint32_t b, std::uint8_t from) {
    if (a > b) std::swap(a, b);
    MergedPlace both = places_[a].merged;
    both.add(places_[b].merged);
    const double cost = both.error(both.position()) + evenness * length(a, b);
    push({static_cast<float>(cost), a, b, ages_of(a, b)}, from);
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
            before[k] = positions_[corners_[t][k]];
            after[k] = corners_[t][k] == moved ? to : before[k];
        }
        const Vec3 was = cross(before[1] - before[0], before[2] - before[0]),
                   is = cross(after[1] - after[0], after[2] - after[0]);
        const double along = dot(was, is);
        if (!(along > 0 && along * along > least_cosine * least_cosine * dot(was, was) * dot(is, is)))
            return true;
    }
    return false;
}

void Contraction::merge(std::uint32_t a, std::uint32_t b, Vec3 position) {
    Place &into = places_[a], &from = places_[b];
    parent_[b] = a;
    into.merged.add(from.merged);
    positions_[a] = position;
    ++ages_[a], ++ages_[b];
    merge_shades(a, b);
    for (const std::uint32_t t : from.around) {
        if (!left_[t]) continue;
        auto& corners = corners_[t];
        if (has(corners, a)) {
            left_[t] = 0;
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

void Contraction::merge_shades(std::uint32_t a, std::uint32_t b) {
    for (std::uint32_t shade = places_[b].first_shade; shade != none;) {
        const std::uint32_t next = shades_[shade].next, same = shade_at(a, shades_[shade].side);
        if (same != none) {
            shades_[same].sum.add(shades_[shade].sum);
        } else {
            shades_[shade].next = std::exchange(places_[a].first_shade, shade);
        }
        shade = next;
    }
}

/// With those of `lowest` and above.
void Contraction::propose_around(std::uint32_t a, std::uint32_t lowest, std::uint8_t from) {
    std::vector<std::uint32_t>& neighbours = pieces_[from].neighbours;
    neighbours.clear();
    for (const std::uint32_t t : places_[a].around)
        for (const std::uint32_t place : corners_[t])
            if (place != a && place >= lowest) neighbours.push_back(place);
    std::ranges::sort(neighbours);
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    for (const std::uint32_t place : neighbours) propose(a, place, from);
}

/// What was merged with a place of another piece has triangles with others there.
void Contraction::share_neighbours(std::uint32_t place) {
    home_[place] = shared;
    for (const std::uint32_t t : places_[place].around)
        for (const std::uint32_t corner : corners_[t])
            if (piece_of(corner) != piece_of(place)) home_[corner] = shared;
}

void Contraction::until(double limit) {
    in_pieces([&](std::uint8_t piece) { contract(piece, limit); });
    contract(shared, limit);
}

/// Mergers that turn triangles over wait until the limit is as large as what moves; those at hubs, until
/// mergers around them have left less there.
void Contraction::contract(std::uint8_t piece, double limit) {
    Queue& mergers = pieces_[piece].mergers;
    while (mergers.least_cost() <= limit) {
        Merger m = mergers.pop();
        if (!is_current(m)) continue;
        if (piece != shared && home_of(m) != piece) {
            push(m, piece);
            continue;
        }
        if (is_hub(m)) {
            m.cost = 2 * std::max(m.cost, cheapest);
            mergers.push(m);
            continue;
        }
        MergedPlace both = places_[m.a].merged;
        both.add(places_[m.b].merged);
        const Vec3 to = both.position();
        if (m.ages < forced && (turns_over(m.a, m.b, to) || turns_over(m.b, m.a, to))) {
            m.cost = std::max(m.cost, static_cast<float>(length(m.a, m.b)));
            m.ages |= forced;
            mergers.push(m);
            continue;
        }
        merge(m.a, m.b, to);
        if (piece == shared) share_neighbours(m.a);
        propose_around(m.a, 0, piece);
    }
}

std::vector<std::uint32_t> Contraction::into() const {
    std::vector<std::uint32_t> out;
    out.reserve(places_.size());
    for (std::uint32_t i = 0; i < parent_.size(); ++i)
        out.push_back(parent_[i] == i ? i : out[parent_[i]]);  // merged into one of a lower number
    return out;
}

}  // namespace echoloop
