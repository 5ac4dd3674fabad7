// Over how much range the echo of each sample of a level line is spread. Keeps to the sample: what lies
// between two of them it never guesses, since the mean over pings would not forgive it.
#pragma once

#include "render/fan/pixel_rows.h"

namespace echoloop {

/// Each sample keeps its echo, which has the right mean over pings whatever there is, and spreads it over
/// what a pixel of the usual size shows of its plane (EchoSpread). Side by side these cover a plane without a
/// gap, since 1 / R is linear in the image plane: no ping is a comb. None depends on its neighbours, so the
/// mean does not depend on the number of pixels. Where View::sharp_outlines says so, a sample less than a
/// usual pixel from an outline stays where it is; its neighbours are those a usual pixel away.
///
/// `bin_length` and `end` of the window: m. Samples without a surface get meaningless extents.
void find_spreads(const PixelRow& row, const View& view, float bin_length, float end, Extents& out);

}  // namespace echoloop
