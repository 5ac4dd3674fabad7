#include "emulator/devices/imagenex-deltat/timestamp.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <string>

namespace echoloop::delta_t {
namespace {

std::string digits(std::int64_t value, std::size_t count) {
    const std::string text = std::to_string(value);
    return text.size() < count ? std::string(count - text.size(), '0') + text : text;
}

std::string month_name(unsigned month, bool upper) {
    constexpr const char* names[] = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                     "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    std::string name = names[month - 1];
    if (upper)
        std::transform(name.begin(), name.end(), name.begin(),
                       [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return name;
}

}  // namespace

void put_time(imagenex::Profile83P& profile, double time, bool upper_month) {
    using namespace std::chrono;
    constexpr double last = 253402300799;  // of year 9999
    const sys_time<milliseconds> at{
        milliseconds(static_cast<std::int64_t>(1000 * std::clamp(time, 0.0, last)))};
    const auto day = floor<days>(at);
    const year_month_day date{day};
    const hh_mm_ss clock{at - day};
    const std::int64_t ms = clock.subseconds().count();
    profile.date =
        wire::Text<12>(digits(unsigned(date.day()), 2) + '-' +
                       month_name(unsigned(date.month()), upper_month) + '-' + digits(int(date.year()), 4));
    profile.time = wire::Text<9>(digits(clock.hours().count(), 2) + ':' + digits(clock.minutes().count(), 2) +
                                 ':' + digits(clock.seconds().count(), 2));
    profile.hundredths = wire::Text<4>('.' + digits(ms / 10, 2));
    profile.milliseconds = wire::Text<5>('.' + digits(ms, 3));
}

}  // namespace echoloop::delta_t
