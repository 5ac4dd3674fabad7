#include "render/paths/chains.h"

#include <cmath>

namespace echoloop {

ChainShare chain_share(std::span<const ChainMirror> mirrors, double spread) {
    // det(I + S (a a' + b b') / w) = det of the 2 x 2 matrix I + [a b]' S [a b] / w (Sylvester).
    double aa = 0, ab = 0, bb = 0;
    for (const ChainMirror& mirror : mirrors) {
        const double s = 4 * mirror.slope * mirror.slope, a = mirror.at - 1, b = mirror.at;
        aa += s * a * a, ab += s * a * b, bb += s * b * b;
    }
    const double w = 1 / (spread * spread);
    const double determinant = (1 + aa * w) * (1 + bb * w) - ab * w * ab * w;
    return {1 / std::sqrt(determinant), bb / (1 + 2 * bb * w)};
}

}  // namespace echoloop
