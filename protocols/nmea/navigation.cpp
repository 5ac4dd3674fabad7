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

/// Rounded to a hundredth of a second, so that no field says 60.00 s.
struct Civil {
    explicit Civil(const Moment& moment) {
        using namespace std::chrono;
        const auto hundredths = static_cast<std::int64_t>(std::llround(moment.unix_time * 100));
        const sys_time<duration<std::int64_t, std::centi>> time{
            duration<std::int64_t, std::centi>(hundredths)};
        const auto day = floor<days>(time);
        date = year_month_day(day);
        const hh_mm_ss clock(time - day);
        hours = static_cast<int>(clock.hours().count());
        minutes = static_cast<int>(clock.minutes().count());
        seconds = static_cast<double>(clock.seconds().count()) +
                  0.01 * static_cast<double>(clock.subseconds().count());
    }
    std::string clock() const { return text("%02d%02d%05.2f", hours, minutes, seconds); }

    std::chrono::year_month_day date;
    int hours = 0, minutes = 0;
    double seconds = 0;
};

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

}  // namespace echoloop::nmea
