#include "render/scene/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace echoloop {
namespace {

constexpr std::size_t most_edges = 256;
constexpr double straight_cosine = 0.99996192;  ///< of half a degree

struct Piece {
    Vec3 start, end;
};

/// Edges that follow each other in one line become one; where several edges leave a place, any may follow.
std::vector<Piece> straight_pieces(std::span<const OutlineEdge> edges) {
    std::vector<OutlineEdge> sorted(edges.begin(), edges.end());
    std::ranges::sort(sorted, {}, &OutlineEdge::from);
    std::vector<bool> used(sorted.size());
    const auto next_of = [&](std::uint32_t place) {
        auto at = std::ranges::lower_bound(sorted, place, {}, &OutlineEdge::from) - sorted.begin();
        for (; static_cast<std::size_t>(at) < sorted.size() &&
               sorted[static_cast<std::size_t>(at)].from == place;
             ++at)
            if (!used[static_cast<std::size_t>(at)]) return static_cast<std::size_t>(at);
        return sorted.size();
    };
    const auto in_line = [](const Piece& piece, Vec3 end) {
        const Vec3 a = piece.end - piece.start, b = end - piece.end;
        return dot(a, b) > straight_cosine * norm(a) * norm(b);
    };
    std::vector<Piece> pieces;
    for (std::size_t seed = 0; seed < sorted.size(); ++seed) {
        const std::size_t first = pieces.size();
        for (std::size_t at = seed; at < sorted.size() && !used[at]; at = next_of(sorted[at].to)) {
            used[at] = true;
            if (pieces.size() > first && in_line(pieces.back(), sorted[at].end))
                pieces.back().end = sorted[at].end;
            else
                pieces.push_back({sorted[at].start, sorted[at].end});
        }
        if (pieces.size() > first + 1 && in_line(pieces.back(), pieces[first].end)) {
            pieces[first].start = pieces.back().start;
            pieces.pop_back();
        }
    }
    return pieces;
}

Vec3 longest_direction(std::span<const Piece> pieces) {
    Vec3 best;
    for (const Piece& piece : pieces)
        if (const Vec3 along = piece.end - piece.start; norm(along) > norm(best)) best = along;
    return best;
}

}  // namespace

OutlinedFace outlined(Vec3 middle, Vec3 normal, std::span<const OutlineEdge> edges) {
    const auto pieces = straight_pieces(edges);
    OutlinedFace out;
    SceneFace& face = out.face;
    face.origin = middle, face.normal = normal;
    Vec3 u = longest_direction(pieces);
    u = u - dot(u, normal) * normal;
    if (!(norm(u) > 0)) u = std::abs(normal.z) < 0.9 ? cross(normal, {0, 0, 1}) : cross(normal, {1, 0, 0});
    face.u = 1 / norm(u) * u;
    face.v = cross(normal, face.u);
    face.low[0] = face.low[1] = std::numeric_limits<double>::infinity();
    face.high[0] = face.high[1] = -std::numeric_limits<double>::infinity();
    const auto flat = [&](Vec3 p) {
        const double at[2] = {dot(p - middle, face.u), dot(p - middle, face.v)};
        for (int axis = 0; axis < 2; ++axis) {
            face.low[axis] = std::min(face.low[axis], at[axis]);
            face.high[axis] = std::max(face.high[axis], at[axis]);
        }
        return std::array<float, 2>{static_cast<float>(at[0]), static_cast<float>(at[1])};
    };
    for (const Piece& piece : pieces) out.edges.push_back({flat(piece.start), flat(piece.end)});
    if (out.edges.size() <= most_edges) return out;
    const auto low_u = static_cast<float>(face.low[0]), high_u = static_cast<float>(face.high[0]),
               low_v = static_cast<float>(face.low[1]), high_v = static_cast<float>(face.high[1]);
    out.edges = {{{low_u, low_v}, {high_u, low_v}},
                 {{high_u, low_v}, {high_u, high_v}},
                 {{high_u, high_v}, {low_u, high_v}},
                 {{low_u, high_v}, {low_u, low_v}}};
    return out;
}

}  // namespace echoloop
