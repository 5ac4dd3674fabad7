// Bottom detection as a bathymetric head does it: one arrival time per beam, by magnitude near the specular
// direction and by the middle of the footprint further out. Pure functions of the echogram.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/devices/r2sonic/controls.h"
#include "render/echogram.h"

namespace echoloop::r2sonic_device {

/// Two-way times between which a bottom is looked for, s.
struct TimeGate {
    double min = 0, max = 0;
};

struct Detection {
    double time = 0;           ///< two-way, s; 0: no bottom
    float power = 0;           ///< uPa^2 at the peak
    std::uint8_t quality = 0;  ///< nibble of Q0; 0: no bottom
};

/// The gate of one beam from depth and range gates. `last_depth` (m, 0: unknown) serves the automatic gates.
TimeGate beam_gate(const Controls& controls, double angle, double sound_speed, double last_depth,
                   double window);

/// Detection in one beam: the strongest stretch as long as the beam's footprint on a flat bottom, so that
/// speckle does not break it up. It must lie `margin` dB above the echogram's noise.
Detection detect(const Echogram& echogram, std::size_t beam, TimeGate gate, double margin);

/// Depth below the head of the beams within 30 deg of the axis: their median, m; 0 if there is none.
double median_depth(const std::vector<Detection>& detections, const std::vector<double>& angles,
                    double sound_speed);

}  // namespace echoloop::r2sonic_device
