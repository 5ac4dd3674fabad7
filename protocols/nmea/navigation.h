// NMEA 0183 sentences of a satellite receiver as text. Writes only; reads nothing.
#pragma once

#include <string>

namespace echoloop::nmea {

/// UTC.
struct Moment {
    double unix_time = 0;  ///< s since 1970
};

/// Latitude and longitude in deg, north and east.
struct Fix {
    Moment time;
    double latitude = 0, longitude = 0;
    double altitude = 0;  ///< m above the sea's mean level
};

/// A position of a receiver with corrections to the centimetre (quality 4), seven decimals of a minute.
std::string gga(const Fix& fix, const std::string& talker);
std::string zda(const Moment& time, const std::string& talker);
/// Errors of the position in m, as a receiver with corrections has them.
std::string gst(const Moment& time, double horizontal, double vertical, const std::string& talker);

}  // namespace echoloop::nmea
