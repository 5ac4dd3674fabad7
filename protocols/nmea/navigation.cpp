#include "protocols/nmea/navigation.h"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "protocols/nmea/sentences.h"

namespace echoloop::nmea {
namespace {

template <class... Values>
std::string text(const char* format, Values... values) {
    char buffer[200];
    std::snprintf(buffer, sizeof buffer, format, values...);
    return buffer;
}

/// Rounded to so many decimals of a second, so that no field says 60.00 s.
struct Civil {
    explicit Civil(const Moment& moment, int decimals_of_second = 2) : decimals(decimals_of_second) {
        using namespace std::chrono;
        const double parts = std::pow(10, decimals);
        const auto whole = static_cast<std::int64_t>(std::llround(moment.unix_time * parts));
        const auto parts_of_second = static_cast<std::int64_t>(parts);
        const sys_seconds time{std::chrono::seconds(whole / parts_of_second)};
        const auto day = floor<days>(time);
        date = year_month_day(day);
        const hh_mm_ss clock(time - day);
        hours = static_cast<int>(clock.hours().count());
        minutes = static_cast<int>(clock.minutes().count());
        seconds = static_cast<double>(clock.seconds().count()) +
                  static_cast<double>(whole % parts_of_second) / parts;
    }
    std::string clock() const {
        return text("%02d%02d%0*.*f", hours, minutes, decimals + 3, decimals, seconds);
    }

    std::chrono::year_month_day date;
    int decimals = 2;
    int hours = 0, minutes = 0;
    double seconds = 0;
};

/// Of a circle, to a hundredth, so that no field says 360.00 deg.
double bearing(double degrees) {
    constexpr long turn = 36000;
    return static_cast<double>(((std::lround(100 * degrees) % turn) + turn) % turn) / 100;
}

/// "5924.0000000,N": rounded as a whole, so that no field says 60 minutes.
std::string place(double degrees, int digits, char positive, char negative) {
    constexpr double parts = 60e7;  // of a degree
    const auto whole = static_cast<std::int64_t>(std::llround(std::abs(degrees) * parts));
    const std::int64_t full = whole / static_cast<std::int64_t>(parts);
    const double minutes = static_cast<double>(whole % static_cast<std::int64_t>(parts)) / 1e7;
    return text("%0*lld%010.7f,%c", digits, static_cast<long long>(full), minutes,
                degrees < 0 ? negative : positive);
}

}  // namespace

std::string gga(const Fix& fix, const std::string& talker) {
    return sentence(talker + "GGA," + Civil(fix.time).clock() + ',' + place(fix.latitude, 2, 'N', 'S') + ',' +
                    place(fix.longitude, 3, 'E', 'W') +
                    text(",4,12,0.8,%.3f,M,0.000,M,1.0,0001", fix.altitude));
}

std::string zda(const Moment& time, const std::string& talker) {
    const Civil civil(time);
    return sentence(talker + "ZDA," + civil.clock() +
                    text(",%02u,%02u,%04d,00,00", static_cast<unsigned>(civil.date.day()),
                         static_cast<unsigned>(civil.date.month()), static_cast<int>(civil.date.year())));
}

std::string gst(const Moment& time, double horizontal, double vertical, const std::string& talker) {
    return sentence(talker + "GST," + Civil(time).clock() +
                    text(",%.3f,%.3f,%.3f,0.0,%.3f,%.3f,%.3f", horizontal, horizontal, horizontal, horizontal,
                         horizontal, vertical));
}

std::string hdt(double heading, const std::string& talker) {
    return sentence(talker + text("HDT,%.2f,T", bearing(heading)));
}

std::string vtg(double course, double speed, const std::string& talker) {
    constexpr double knot = 1852.0 / 3600, kilometre_per_hour = 1 / 3.6;  // m/s
    return sentence(talker + text("VTG,%.2f,T,,M,%.3f,N,%.3f,K,D", bearing(course), speed / knot,
                                  speed / kilometre_per_hour));
}

std::string pashr(const Attitude& a) {
    return sentence("PASHR," + Civil(a.time, 3).clock() +
                    text(",%.2f,T,%+.2f,%+.2f,%+.2f,%.3f,%.3f,%.3f,2,1", bearing(a.heading), a.roll, a.pitch,
                         a.heave, a.tilt_error, a.tilt_error, a.heading_error));
}

}  // namespace echoloop::nmea
