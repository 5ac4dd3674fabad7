// Makes a mesh coarser by contracting its edges, the one that changes the surface least first (Garland and
// Heckbert 1997), so that flat parts become few large triangles and bends keep theirs. Deterministic with any
// number of threads; knows no chunks.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/clusters.h"
#include "render/scene/mesh_loops.h"

namespace echoloop {

class Contraction {
  public:
    explicit Contraction(const Clusters& clusters);

    /// Merges places as long as the surface gets at most about `limit` m off there.
    void until(double limit);
    /// m, how far the next merger would bring the surface off, or more; infinite where there is none.
    double next_error();

    /// Of the clusters.
    std::size_t places() const { return places_.size(); }
    std::size_t triangles() const { return left_.size(); }
    /// Whether a triangle of the clusters is left.
    bool is_left(std::size_t triangle) const { return left_[triangle]; }
    /// The places of a triangle's corners: those into which others have been merged.
    const std::array<std::uint32_t, 3>& corners(std::size_t triangle) const { return corners_[triangle]; }
    /// Triangles at such a place, also some that are no longer left.
    std::span<const std::uint32_t> around(std::uint32_t place) const { return places_[place].around; }
    /// Of each place of the clusters, that into which it has been merged; or itself.
    std::vector<std::uint32_t> into() const;

    std::size_t vertices() const { return shades_.size(); }
    /// A corner's vertex: two at one place differ in their normals only.
    std::uint32_t vertex(std::size_t triangle, std::size_t corner) const;
    Vec3 position(std::uint32_t place) const { return middle_ + positions_[place]; }
    /// m, about how far the merged surface is off around the place.
    double error(std::uint32_t place) const { return places_[place].merged.error(positions_[place]); }
    /// Of the normals by area, of all that has been merged into the vertex.
    MeanNormal normal(std::uint32_t vertex) const { return shades_[vertex].sum.mean(); }

  private:
    struct Place {
        MergedPlace merged;
        std::uint32_t first_shade = none;   ///< of those at this place
        std::vector<std::uint32_t> around;  ///< triangles, also some that are no longer left
        std::size_t left = 0;               ///< of those
    };
    /// A vertex; several at one place form a list.
    struct Shade {
        NormalSum sum;
        std::uint32_t side, next;
    };
    /// To merge two places.
    struct Merger {
        float cost;  ///< m
        std::uint32_t a, b;
        std::uint32_t
            ages;  ///< of both together when this was proposed; the top bit: though triangles turn over
    };
    /// Those of nearly the same cost, in the order in which they came: for a million of them a heap would be
    /// slower than all the rest.
    class Queue {
      public:
        void push(const Merger& merger);
        /// Of the cheapest; there is one.
        Merger pop();
        /// m, of the cheapest, to a tenth; infinite where there is none.
        double least_cost();

      private:
        struct Bucket {
            std::size_t next = 0;
            std::vector<Merger> mergers;
        };
        std::vector<Bucket> buckets_;
        std::size_t cheapest_ = 0;  ///< no merger is in a bucket before
    };

    /// Large meshes are contracted in pieces, ranges of their places, each on one thread: mergers of places
    /// of which all triangles lie within the piece. All others follow on one thread.
    struct Piece {
        Queue mergers;
        std::vector<Merger> across;  ///< on their way to across_
        std::vector<std::uint32_t> neighbours;
    };

    static constexpr std::uint32_t forced = 1U << 31U, none = ~0U;
    static constexpr std::uint8_t most_pieces = 8, shared = most_pieces;

    void list_triangles(const Clusters& clusters);
    void list_shades(const Clusters& clusters);
    void find_homes();
    std::uint8_t piece_of(std::uint32_t place) const {
        return static_cast<std::uint8_t>(place / places_a_piece_);
    }
    std::uint8_t home_of(const Merger& m) const { return home_[m.a] == home_[m.b] ? home_[m.a] : shared; }
    /// On the thread of `from`.
    void push(const Merger& merger, std::uint8_t from);
    /// Calls work(number) of all pieces, and takes what goes across them.
    template <typename Work>
    void in_pieces(const Work& work);
    void contract(std::uint8_t piece, double limit);
    void share_neighbours(std::uint32_t place);
    void propose(std::uint32_t a, std::uint32_t b, std::uint8_t from);
    /// It grows with each change of either.
    std::uint32_t ages_of(std::uint32_t a, std::uint32_t b) const { return (ages_[a] + ages_[b]) & ~forced; }
    double length(std::uint32_t a, std::uint32_t b) const { return norm(positions_[a] - positions_[b]); }
    bool is_current(const Merger& m) const { return ages_of(m.a, m.b) == (m.ages & ~forced); }
    bool is_hub(const Merger& m) const;
    bool turns_over(std::uint32_t moved, std::uint32_t other, Vec3 to) const;
    void merge(std::uint32_t a, std::uint32_t b, Vec3 position);
    void merge_shades(std::uint32_t a, std::uint32_t b);
    std::uint32_t shade_at(std::uint32_t place, std::uint32_t side) const;
    void propose_around(std::uint32_t a, std::uint32_t lowest, std::uint8_t from);

    Vec3 middle_;
    std::vector<Place> places_;
    std::vector<Vec3> positions_;  ///< of the places, from the middle
    std::vector<std::uint32_t>
        ages_;  ///< how often each place has changed; to go into another is a change, too
    std::vector<Shade> shades_;
    std::vector<std::uint32_t> parent_;  ///< the place into which each was merged, a lower one; or itself
    std::vector<std::array<std::uint32_t, 3>> corners_;
    std::vector<std::array<std::uint8_t, 3>> sides_;  ///< of the corners' normals
    std::vector<std::uint8_t> left_;
    MeshLoops loops_;
    std::uint32_t places_a_piece_ = 1;
    std::vector<std::uint8_t> home_;             ///< of each place: its piece, or shared
    std::array<Piece, most_pieces + 1> pieces_;  ///< the last one: what goes across
};

}  // namespace echoloop
