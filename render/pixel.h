// What the renderer draws for one sample of a picture. The shader writes it; whoever sums echoes reads it.
#pragma once

namespace echoloop {

struct Pixel {
    float range;      ///< m, Euclidean, at the sample point
    float cosine;     ///< of the angle of incidence, 0..1
    float footprint;  ///< m, range that a pixel of the usual size covers on its surface's plane; negative:
                      ///< mostly along bearing
    float surface;    ///< 0: nothing; else 1 + index of its object and material
};

}  // namespace echoloop
