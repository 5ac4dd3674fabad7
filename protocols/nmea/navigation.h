// NMEA 0183 sentences of a satellite receiver and of an inertial unit as text. Writes only; reads nothing.
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

/// Heading in deg, clockwise from true north.
std::string hdt(double heading, const std::string& talker);
/// Course in deg, clockwise from true north, and speed in m/s over ground.
std::string vtg(double course, double speed, const std::string& talker);

/// Angles in deg: roll with port up, pitch with the bow up; heave in m, up.
struct Attitude {
    Moment time;
    double heading = 0, roll = 0, pitch = 0, heave = 0;
    double tilt_error = 0, heading_error = 0;  ///< deg, standard deviations
};
/// $PASHR as OxTS, Applanix and NovaTel write it, with thousandths of a second and signs always.
std::string pashr(const Attitude& attitude);

}  // namespace echoloop::nmea
