// The colours of a picture. The scale goes from near black over amber to near white in even steps of
// lightness (OKLab), so that it also reads in grey and with any colour vision.
#pragma once

#include "tools/draw/image.h"

namespace echoloop::draw {

inline constexpr Color background{16, 20, 26};
inline constexpr Color ink{205, 212, 220};
inline constexpr Color faint_ink{128, 138, 150};
inline constexpr Color grid_ink{120, 150, 185};

/// The colour of a level: 0 the darkest, 1 the brightest; outside it is clamped.
Color palette(double level);

}  // namespace echoloop::draw
