#include "render/scene/chunks.h"

#include <algorithm>
#include <array>
#include <future>
#include <limits>

#include "render/scene/mesh_loops.h"
#include "render/scene/scratch.h"

namespace echoloop {
namespace {

/// A triangle on its way through the tree: what is compared moves with it.
struct Item {
    std::array<float, 4> size_at;  ///< m: x, y, z of its centre, and the longest side of its box
    std::uint32_t triangle;

    float extent() const { return size_at[3]; }
};
using Items = std::span<Item>;

void list_items(std::span<const Vec3> positions, std::span<const std::uint32_t> indices, Items out) {
    MeshLoops(out.size()).each(out.size(), [&](std::size_t triangle) {
        const std::size_t i = 3 * triangle;
        const Vec3 &a = positions[indices[i]], &b = positions[indices[i + 1]], &c = positions[indices[i + 2]];
        const auto side = [](double u, double v, double w) {
            return std::max({u, v, w}) - std::min({u, v, w});
        };
        out[triangle] = {
            {static_cast<float>((a.x + b.x + c.x) / 3), static_cast<float>((a.y + b.y + c.y) / 3),
             static_cast<float>((a.z + b.z + c.z) / 3),
             static_cast<float>(std::max({side(a.x, b.x, c.x), side(a.y, b.y, c.y), side(a.z, b.z, c.z)}))},
            static_cast<std::uint32_t>(triangle)};
    });
}

/// Along which the centres lie farthest apart.
struct Axis {
    std::size_t index = 0;
    float low = 0, length = 0;  ///< m
    float largest = 0;          ///< m, extent of an item
};

Axis longest_axis(Items items) {
    constexpr float far = std::numeric_limits<float>::infinity();
    std::array<float, 4> low{far, far, far, far}, high{-far, -far, -far, -far};
    for (const Item& item : items)
        for (std::size_t k = 0; k < 4; ++k) {
            low[k] = std::min(low[k], item.size_at[k]);
            high[k] = std::max(high[k], item.size_at[k]);
        }
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
        if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
    return {longest, low[longest], high[longest] - low[longest], high[3]};
}

/// Moves the `half` lowest along an axis to the front.
void move_lower(Items items, std::size_t axis, std::size_t half) {
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                     [axis](const Item& a, const Item& b) {
                         return a.size_at[axis] != b.size_at[axis] ? a.size_at[axis] < b.size_at[axis]
                                                                   : a.triangle < b.triangle;
                     });
}

/// The same of many, through `spare`: sorted into buckets along the axis, only one of which is taken apart.
/// Without a branch for each item, which would be foretold wrongly every second time.
void move_lower_by_buckets(Items items, Items spare, const Axis& axis, std::size_t half) {
    constexpr std::int32_t buckets = 1024;
    const float scale = static_cast<float>(buckets) / axis.length;
    const auto bucket_of = [&](const Item& item) {
        const auto bucket = static_cast<std::int32_t>((item.size_at[axis.index] - axis.low) * scale);
        return static_cast<std::size_t>(std::min(bucket, buckets - 1));
    };
    std::array<std::uint32_t, buckets> sizes{};
    for (const Item& item : items) ++sizes[bucket_of(item)];
    std::size_t middle = 0, below = 0;
    while (below + sizes[middle] <= half) below += sizes[middle++];
    const Items own = spare.subspan(below, sizes[middle]);
    std::array<Item*, 3> next{spare.data(), own.data(), own.data() + own.size()};
    for (const Item& item : items) {
        const std::size_t bucket = bucket_of(item);
        *next[std::size_t{bucket >= middle} + std::size_t{bucket > middle}]++ = item;
    }
    move_lower(own, axis.index, half - below);
    std::ranges::copy(spare, items.begin());
}

/// Makes the nodes of a range of items, which it sorts.
class TreeMaker {
  public:
    /// `spare`: room for as many items.
    TreeMaker(Items items, Items spare, std::vector<ChunkNode>& nodes)
        : items_(items), spare_(spare), nodes_(nodes) {}

    void add_node(std::size_t first, std::size_t count) {
        const std::size_t node = nodes_.size();
        nodes_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count), 0});
        if (count <= chunk_triangles)
            std::ranges::sort(items_.subspan(first, count), {}, &Item::triangle);  // the file's order
        else
            add_children(first, count);
        nodes_[node].next = static_cast<std::uint32_t>(nodes_.size());
    }

  private:
    void add_children(std::size_t first, std::size_t count) {
        const Axis longest = longest_axis(items_.subspan(first, count));
        const std::size_t large = large_ones(first, count, longest);
        if (large > 0) {
            add_node(first, large);
            add_node(first + large, count - large);
            return;
        }
        const std::size_t half = split(first, count, longest);
        if (count < worth_a_thread) {
            add_halves(first, half);
            add_halves(first + half, count - half);
            return;
        }
        std::vector<ChunkNode> second;
        std::future<void> done = std::async(std::launch::async | std::launch::deferred, [&] {
            TreeMaker(items_, spare_, second).add_halves(first + half, count - half);
        });
        add_halves(first, half);
        done.get();
        append(second);
    }

    void add_halves(std::size_t first, std::size_t count) {
        const std::size_t half = split(first, count, longest_axis(items_.subspan(first, count)));
        add_node(first, half);
        add_node(first + half, count - half);
    }

    /// Nodes that were counted from 0.
    void append(std::span<const ChunkNode> more) {
        const auto before = static_cast<std::uint32_t>(nodes_.size());
        for (ChunkNode node : more) {
            node.next += before;
            nodes_.push_back(node);
        }
    }

    /// Moves the few triangles that are as large as half of the node or larger to the front and returns how
    /// many there are: a wall among the small triangles of a seabed would make every chunk that has a part of
    /// it as large as the wall.
    std::size_t large_ones(std::size_t first, std::size_t count, const Axis& longest) {
        const Items items = items_.subspan(first, count);
        const float limit = longest.length / 2;
        if (longest.largest < limit) return 0;
        const auto is_large = [&](const Item& item) { return item.extent() >= limit; };
        const auto large = static_cast<std::size_t>(std::ranges::count_if(items, is_large));
        if (large == 0 || large > count / 8) return 0;
        std::ranges::stable_partition(items, is_large);
        return large;
    }

    /// Moves the lower half along the longest axis to the front and returns its size.
    std::size_t split(std::size_t first, std::size_t count, const Axis& longest) {
        constexpr std::size_t worth_buckets = 512;
        constexpr float least = 1e-6F;  // m, that can be cut into buckets
        const Items items = items_.subspan(first, count);
        if (count < worth_buckets || longest.length < least)
            move_lower(items, longest.index, count / 2);
        else
            move_lower_by_buckets(items, spare_.subspan(first, count), longest, count / 2);
        return count / 2;
    }

    static constexpr std::size_t worth_a_thread = 400'000;  ///< triangles

    const Items items_, spare_;
    std::vector<ChunkNode>& nodes_;
};

}  // namespace

ChunkTree cut_into_chunks(std::span<const Vec3> positions, std::span<const std::uint32_t> indices) {
    Scratch<Item> items(indices.size() / 3);
    list_items(positions, indices, items.all());
    ChunkTree tree;
    {
        Scratch<Item> spare(items.size());
        TreeMaker(items.all(), spare.all(), tree.nodes).add_node(0, items.size());
    }
    tree.triangles.reserve(items.size());
    for (const Item& item : items.all()) tree.triangles.push_back(item.triangle);
    return tree;
}

}  // namespace echoloop
