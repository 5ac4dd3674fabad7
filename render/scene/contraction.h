// Makes a mesh coarser by contracting its edges, the one that changes the surface least first (Garland and
// Heckbert 1997), so that flat parts become few large triangles and bends keep theirs. Deterministic; knows
// no chunks.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/clusters.h"

namespace echoloop {

class Contraction {
  public:
    explicit Contraction(const Clusters& clusters);

    /// Merges places as long as the surface gets at most about `limit` m off there.
    void until(double limit);
    /// m, how far the next merger would bring the surface off, or more; infinite where there is none.
    double next_error() { return mergers_.least_cost(); }

    /// Whether a triangle of the clusters is left.
    bool is_left(std::size_t triangle) const { return left_[triangle]; }
    /// Of each place of the clusters, the number of that into which it has been merged, from 0 without gaps.
    std::vector<std::uint32_t> into() const;

  private:
    struct Place {
        MergedPlace merged;
        Vec3 position;
        std::uint32_t age = 0;              ///< how often it has changed
        std::vector<std::uint32_t> around;  ///< triangles, also some that are no longer left
        std::size_t left = 0;               ///< of those
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

    static constexpr std::uint32_t forced = 1U << 31U;

    void propose(std::uint32_t a, std::uint32_t b);
    /// It grows with each change of either.
    std::uint32_t ages_of(std::uint32_t a, std::uint32_t b) const {
        return (places_[a].age + places_[b].age) & ~forced;
    }
    double length(std::uint32_t a, std::uint32_t b) const {
        return norm(places_[a].position - places_[b].position);
    }
    bool is_current(const Merger& m) const;
    bool is_hub(const Merger& m) const;
    bool turns_over(std::uint32_t moved, std::uint32_t other, Vec3 to) const;
    void merge(std::uint32_t a, std::uint32_t b, Vec3 position);
    void propose_around(std::uint32_t a);

    std::vector<Place> places_;
    std::vector<std::uint32_t> parent_;  ///< the place into which each was merged, a lower one; or itself
    std::vector<std::array<std::uint32_t, 3>> corners_;
    std::vector<bool> left_;
    Queue mergers_;
    std::vector<std::uint32_t> neighbours_;
};

}  // namespace echoloop
