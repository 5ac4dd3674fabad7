// The pitch and roll sensor in the head of an 831L: what two accelerometers feel, gravity included, and the
// angles that follow from them. Pure functions.
#pragma once

#include "emulator/contract/sensors.h"

namespace echoloop::imagenex831l {

/// Accelerations in g. The head's long axis is z, its transducer at the lower end; 0 deg of it is along x.
struct Tilt {
    double roll = 0;   ///< along y: positive where the head has turned clockwise, seen from its tail
    double pitch = 0;  ///< along -z: positive where the transducer's end is up
    friend Tilt operator-(const Tilt& a, const Tilt& b) { return {a.roll - b.roll, a.pitch - b.pitch}; }
};

/// Of a head that was at `before` and is at `now`; the same moment twice: at rest.
Tilt felt(const Located& before, const Located& now);
/// What the sensors make of it.
Tilt sensed(const Tilt& truth, const Sensors& sensors, Time now);
/// deg, within +-90, that an acceleration of the Earth's alone stands for.
double angle(double g);

}  // namespace echoloop::imagenex831l
