#include "render/scene/welding.h"

#include <array>
#include <bit>
#include <cmath>

#include "render/scene/numbering.h"
#include "render/scene/scratch.h"

namespace echoloop {
namespace {

using MicroCell = std::array<std::int64_t, 3>;

MicroCell micro_cell(Vec3 p) {
    constexpr double per_metre = 1e6;
    const auto tick = [](double v) { return static_cast<std::int64_t>(std::floor(per_metre * v + 0.5)); };
    return {tick(p.x), tick(p.y), tick(p.z)};
}

std::uint64_t hash_of(const MicroCell& cell) {
    return mix(static_cast<std::uint64_t>(cell[0]), static_cast<std::uint64_t>(cell[1]),
               static_cast<std::uint64_t>(cell[2]));
}

}  // namespace

/// Shares of equal hashes are independent of each other; each is an open table of vertex numbers.
std::vector<std::uint32_t> welded(std::span<const Vec3> positions, MeshLoops& loops) {
    constexpr unsigned share_bits = 2;
    constexpr std::uint32_t empty = ~0U;
    Scratch<std::uint64_t> hashes(positions.size());
    loops.each(positions.size(), [&](std::size_t i) { hashes[i] = hash_of(micro_cell(positions[i])); });
    std::vector<std::uint32_t> first(positions.size());
    loops.parts(std::size_t{1} << share_bits, [&](std::size_t share) {
        const auto is_own = [&](std::uint64_t hash) { return hash >> (64 - share_bits) == share; };
        const auto count = static_cast<std::size_t>(std::ranges::count_if(hashes.all(), is_own));
        std::vector<std::uint32_t> slots(std::bit_ceil(2 * count + 1), empty);
        const std::size_t mask = slots.size() - 1;
        for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
            if (!is_own(hashes[vertex])) continue;
            const MicroCell cell = micro_cell(positions[vertex]);
            std::size_t at = hashes[vertex] & mask;
            while (slots[at] != empty &&
                   (hashes[slots[at]] != hashes[vertex] || micro_cell(positions[slots[at]]) != cell))
                at = (at + 1) & mask;
            if (slots[at] == empty) slots[at] = vertex;
            first[vertex] = slots[at];
        }
    });
    return first;
}

}  // namespace echoloop
