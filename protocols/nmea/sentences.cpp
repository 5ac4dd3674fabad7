#include "protocols/nmea/sentences.h"

#include <cstdio>

namespace echoloop::nmea {
namespace {

constexpr double metres_per_foot = 0.3048;  // international foot, 1959
constexpr double feet_per_fathom = 6;

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    const bool minus_zero = std::string_view(text).find_first_not_of("-0.") == std::string_view::npos;
    return minus_zero && text[0] == '-' ? text + 1 : text;
}

std::string depth_field(Depth value, double unit, int decimals) {
    return value ? fixed(*value / unit, decimals) : std::string();
}

}  // namespace

std::uint8_t checksum(std::string_view body) {
    unsigned sum = 0;
    for (const char c : body) sum ^= static_cast<unsigned char>(c);
    return static_cast<std::uint8_t>(sum);
}

std::string sentence(std::string_view body) {
    char end[8];
    std::snprintf(end, sizeof end, "*%02X\r\n", unsigned{checksum(body)});
    return '$' + std::string(body) + end;
}

std::string depth_below(std::string_view formatter, Depth metres, const Style& style) {
    const auto in = [&](double unit) { return depth_field(metres, unit, style.decimals); };
    return sentence(style.talker + std::string(formatter) + ',' + in(metres_per_foot) + ",f," + in(1) +
                    ",M," + in(metres_per_foot * feet_per_fathom) + ",F");
}

std::string dpt(Depth metres, double offset, std::optional<double> range, const Style& style) {
    std::string body = style.talker + "DPT," + depth_field(metres, 1, style.decimals);
    body += ',' + fixed(offset, style.decimals);
    if (range) body += ',' + fixed(*range, 1);
    return sentence(body);
}

std::string mtw(double celsius, const Style& style) {
    return sentence(style.talker + "MTW," + fixed(celsius, 1) + ",C");
}

}  // namespace echoloop::nmea
