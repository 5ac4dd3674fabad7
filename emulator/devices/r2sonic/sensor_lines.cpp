#include "emulator/devices/r2sonic/sensor_lines.h"

#include <chrono>
#include <cmath>
#include <vector>

#include "protocols/motion/reading.h"
#include "protocols/nmea/sentence.h"
#include "render/pose.h"

namespace echoloop::r2sonic_device {
namespace {

constexpr double slowest = 1250, fastest = 1600;  // m/s, of the manual's SVL0

std::string_view without_end(std::string_view line) {
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
    return line;
}

std::optional<nmea::Sentence> sentence_of(std::string_view line) {
    auto sentence = nmea::read_sentence(without_end(line));
    return sentence && sentence->checksum_fits() ? sentence : std::nullopt;
}

/// $PHOCT,01,hhmmss.sss,T,AA,HHH.HHH,T,eRRR.RRR,T,ePP.PPP,T,eFF.FFF,T,...: roll with port up, pitch with the
/// bow down, heave up (SBG's manual of sbgECom, SBG_ECOM_LOG_NMEA_1_PHOCT).
std::optional<MotionReading> read_phoct(std::string_view line) {
    const auto sentence = sentence_of(line);
    if (!sentence || sentence->address != "PHOCT" || sentence->fields.size() != 19) return {};
    const auto& f = sentence->fields;
    const auto roll = nmea::read_number(f[6]), pitch = nmea::read_number(f[8]),
               heave = nmea::read_number(f[10]);
    const bool valid = f[0] == "01" && f[7] == "T" && f[9] == "T" && f[11] == "T";
    if (!valid || !roll || !pitch || !heave) return {};
    if (std::abs(*roll) > 180 || std::abs(*pitch) > 90) return {};
    return MotionReading{deg_to_rad(*roll), deg_to_rad(*pitch), *heave};
}

/// Digits alone.
std::optional<unsigned> whole(std::string_view text) {
    unsigned value = 0;
    if (text.empty() || text.size() > 6) return {};
    for (const char c : text) {
        if (c < '0' || c > '9') return {};
        value = 10 * value + static_cast<unsigned>(c - '0');
    }
    return value;
}

std::optional<double> unix_time(std::optional<unsigned> year, std::optional<unsigned> month,
                                std::optional<unsigned> day, std::string_view hhmmss) {
    if (hhmmss.size() != 6 || !year || !month || !day) return {};
    const auto hour = whole(hhmmss.substr(0, 2)), minute = whole(hhmmss.substr(2, 2)),
               second = whole(hhmmss.substr(4, 2));
    using namespace std::chrono;
    const year_month_day date{std::chrono::year(static_cast<int>(*year)), std::chrono::month(*month),
                              std::chrono::day(*day)};
    if (!date.ok() || *year < 1970 || !hour || !minute || !second) return {};
    if (*hour > 23 || *minute > 59 || *second > 59) return {};
    const auto days = static_cast<double>(sys_days(date).time_since_epoch().count());
    return 86400 * days + 3600 * *hour + 60 * *minute + *second;
}

/// Whole seconds: the SIM reads no more of a ZDA.
std::optional<TimeReading> read_zda(std::string_view line) {
    const auto sentence = sentence_of(line);
    if (!sentence || sentence->address != "GPZDA" || sentence->fields.size() < 4) return {};
    const auto& f = sentence->fields;
    if (!nmea::read_number(f[0])) return {};
    const auto time =
        unix_time(whole(f[3]), whole(f[2]), whole(f[1]), std::string_view(f[0]).substr(0, f[0].find('.')));
    return time ? std::optional(TimeReading{*time, true}) : std::nullopt;
}

/// "UTC yy.mm.dd hh:mm:ss ab"; the SIM ignores the status ab.
std::optional<TimeReading> read_trimble(std::string_view line) {
    line = without_end(line);
    constexpr std::string_view form = "UTC ##.##.## ##:##:##";
    if (line.size() < form.size()) return {};
    std::string digits;
    for (std::size_t i = 0; i < form.size(); ++i) {
        if (form[i] == '#')
            digits += line[i];
        else if (form[i] != line[i])
            return {};
    }
    const std::string_view d = digits;
    const auto years = whole(d.substr(0, 2));
    if (!years) return {};
    const auto time = unix_time(2000 + *years, whole(d.substr(2, 2)), whole(d.substr(4, 2)), d.substr(6, 6));
    return time ? std::optional(TimeReading{*time, false}) : std::nullopt;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

std::vector<std::string_view> parts_of(std::string_view text) {
    std::vector<std::string_view> parts;
    for (std::size_t comma = text.find(','); comma != text.npos; comma = text.find(',')) {
        parts.push_back(trimmed(text.substr(0, comma)));
        text.remove_prefix(comma + 1);
    }
    parts.push_back(trimmed(text));
    return parts;
}

}  // namespace

std::optional<MotionReading> read_motion(std::string_view line) {
    if (line.starts_with('$')) return read_phoct(line);
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(line.data());
    const auto reading = motion::read({bytes, line.size()});
    if (!reading || reading->format != motion::Format::tss1) return {};
    return MotionReading{deg_to_rad(reading->roll), -deg_to_rad(reading->pitch), reading->heave};
}

std::optional<TimeReading> read_time(std::string_view line) {
    return line.starts_with("UTC ") ? read_trimble(line) : read_zda(line);
}

std::optional<double> read_sound_speed(std::string_view line) {
    constexpr std::size_t svp_c = 19;
    const auto parts = parts_of(without_end(line));
    if (parts.size() != 1 && parts.size() != 4 && parts.size() != 5) return {};
    for (const std::string_view part : parts)
        if (!nmea::read_number(part)) return {};
    std::string_view last = parts.back();
    const bool packed = parts.size() == 1 && last.size() == svp_c && last.find('.') == last.npos;
    if (packed) last = last.substr(0, 5);
    const double speed = nmea::read_number(last).value_or(0) / (packed ? 10 : 1);
    return speed >= slowest && speed <= fastest ? std::optional(speed) : std::nullopt;
}

bool is_sentence(std::string_view line) { return sentence_of(line).has_value(); }

}  // namespace echoloop::r2sonic_device
