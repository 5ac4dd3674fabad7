// The NMEA sentence of Tritech's altimeters.
#pragma once

#include <cstdio>
#include <string>

#include "protocols/nmea/sentences.h"

namespace echoloop::tritech {

/// "$PADBT,016.40,f,005.00,M,002.73,F*30" CR LF.
inline std::string padbt(double metres) {
    constexpr double metres_per_foot = 0.3048, feet_per_fathom = 6;
    const double feet = metres / metres_per_foot;
    char body[96];
    std::snprintf(body, sizeof body, "PADBT,%06.2f,f,%06.2f,M,%06.2f,F", feet, metres,
                  feet / feet_per_fathom);
    return nmea::sentence(body);
}

}  // namespace echoloop::tritech
