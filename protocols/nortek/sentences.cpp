#include "protocols/nortek/sentences.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "protocols/nmea/sentences.h"

namespace echoloop::nortek {
namespace {

constexpr int as_text = -1;
// Decimals: those of the maker's examples, which pynmea2 has, and of published lines.
constexpr std::array beam_fields{
    LineField{"beam", "BEAM", "", "from 1 on"},
    LineField{"date", "DATE", "", "month, day, year", as_text},
    LineField{"time", "TIME", "", "hhmmss.ssss", as_text},
    LineField{"from_trigger", "DT1", "ms", "from the trigger to the middle of the echo", 3},
    LineField{"from_output", "DT2", "ms", "from the start of the line to it", 3},
    LineField{"beam_velocity", "BV", "m/s", "-32.768: none", 5},
    LineField{"merit", "FOM", "m/s", "10: none", 5},
    LineField{"distance", "DIST", "m", "vertical; 0: none", 2},
    LineField{"status", "STAT", "", "as in DvlTrack", as_text}};
constexpr std::array speed_fields{
    LineField{"from_trigger", "DT1", "ms", "from the trigger to the middle of the echo", 3},
    LineField{"from_output", "DT2", "ms", "from the start of the line to it", 3},
    LineField{"speed", "SP", "m/s", "along x and y; -32.768: none", 3},
    LineField{"direction", "DIR", "deg", "of the speed, clockwise from x", 1},
    LineField{"merit", "FOM", "m/s", "10: none", 5},
    LineField{"distance", "D", "m", "vertical, mean of the beams; 0: none", 1}};
constexpr std::array status_fields{
    LineField{"time", "TIME", "s", "Unix time of the trigger", 4},
    LineField{"from_trigger", "DT1", "ms", "from the trigger to the middle of the echo", 3},
    LineField{"from_output", "DT2", "ms", "from the start of the line to it", 3},
    LineField{"velocity_x", "VX", "m/s", "-32.768: none", 4},
    LineField{"velocity_y", "VY", "m/s", "", 4},
    LineField{"velocity_z", "VZ", "m/s", "", 4},
    LineField{"merit", "FOM", "m/s", "10: none", 5},
    LineField{"distance_1", "D1", "m", "vertical; 0: none", 2},
    LineField{"distance_2", "D2", "m", "", 2},
    LineField{"distance_3", "D3", "m", "", 2},
    LineField{"distance_4", "D4", "m", "", 2},
    LineField{"voltage", "BATT", "V", "of the supply", 1},
    LineField{"sound_speed", "SS", "m/s", "", 1},
    LineField{"pressure", "PRESS", "bar", "", 1},
    LineField{"temperature", "TEMP", "degC", "", 1},
    LineField{"status", "STAT", "", "as in DvlTrack", as_text}};
constexpr std::size_t velocity_fields = 11;  // the first ones of status_fields

constexpr std::array forms{
    LineForm{"LineOfBeam", "of one beam: PNORBT0, with tags PNORBT1", beam_fields},
    LineForm{"LineOfSpeed", "PNORBT4 and PNORWT4, with tags PNORBT3 and PNORWT3", speed_fields},
    LineForm{"LineOfVelocity", "PNORBT7 and PNORWT7, with tags PNORBT6 and PNORWT6",
             std::span(status_fields).first<velocity_fields>()},
    LineForm{"LineOfStatus", "PNORBT9 and PNORWT9, with tags PNORBT8 and PNORWT8", status_fields}};

struct Format {
    int number;
    std::string_view address;
    std::size_t form;
    bool tags;
};
constexpr std::array formats{
    Format{350, "PNORBT1", 0, true},  Format{351, "PNORBT0", 0, false}, Format{354, "PNORBT3", 1, true},
    Format{355, "PNORBT4", 1, false}, Format{356, "PNORBT6", 2, true},  Format{357, "PNORBT7", 2, false},
    Format{358, "PNORBT8", 3, true},  Format{359, "PNORBT9", 3, false}, Format{404, "PNORWT3", 1, true},
    Format{405, "PNORWT4", 1, false}, Format{406, "PNORWT6", 2, true},  Format{407, "PNORWT7", 2, false},
    Format{408, "PNORWT8", 3, true},  Format{409, "PNORWT9", 3, false}};

template <class... Values>
std::string printed(const char* format, Values... values) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

/// Never -0.
std::string fixed(double value, int decimals) {
    const std::string text = printed("%.*f", decimals, value);
    return text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos ? text.substr(1)
                                                                                       : text;
}

/// Of the values that are not `none`; `none` if there are no others.
double mean_but(std::span<const float> values, float none) {
    double sum = 0;
    int count = 0;
    for (const float value : values)
        if (value != none) sum += static_cast<double>(value), ++count;
    return count > 0 ? sum / count : static_cast<double>(none);
}

/// Everything that a line has numbers of.
class Numbers {
  public:
    Numbers(const DvlTrack& track, double voltage) : t_(track), voltage_(voltage) {}

    std::string text(std::string_view field, std::size_t beam) const {
        if (field == "date") return printed("%02u%02u%02u", t_.month + 1U, t_.day + 0U, t_.year % 100U);
        if (field == "time")
            return printed("%02u%02u%02u.%04u", t_.hour + 0U, t_.minute + 0U, t_.second + 0U,
                           t_.fraction + 0U);
        if (field == "status") return printed("0x%08X", t_.status);
        return printed("%u", static_cast<unsigned>(beam + 1));
    }
    double number(std::string_view field, const LineForm& form, std::size_t beam) const {
        const bool of_beam = &form == &forms[0], of_speed = &form == &forms[1];
        if (field == "time") return unix_time(t_);
        if (field == "from_trigger")
            return 1e3 * at(of_beam ? t_.beam_from_trigger[beam] : t_.from_trigger[0]);
        if (field == "from_output") return 1e3 * at(of_beam ? t_.beam_from_output[beam] : t_.from_output[0]);
        if (field == "beam_velocity") return at(t_.beam_velocity[beam]);
        if (field == "merit")
            return at(of_beam ? t_.beam_merit[beam]
                              : *std::ranges::max_element(t_.merit.begin(), t_.merit.begin() + 3));
        if (field == "distance") return of_speed ? mean_but(t_.distance, 0) : at(t_.distance[beam]);
        if (field == "speed")
            return moves() ? std::hypot(at(t_.velocity[0]), at(t_.velocity[1])) : at(no_velocity);
        if (field == "direction") return direction();
        if (field == "velocity_x") return at(t_.velocity[0]);
        if (field == "velocity_y") return at(t_.velocity[1]);
        if (field == "velocity_z") return mean_but(std::span(t_.velocity).subspan(2), no_velocity);
        if (field.starts_with("distance_"))
            return at(t_.distance[static_cast<std::size_t>(field.back() - '1')]);
        if (field == "voltage") return voltage_;
        if (field == "sound_speed") return at(t_.sound_speed);
        return at(field == "pressure" ? t_.pressure : t_.temperature);
    }

  private:
    static double at(float value) { return static_cast<double>(value); }
    bool moves() const { return t_.velocity[0] != no_velocity; }
    double direction() const {
        if (!moves()) return 0;
        const double deg = std::atan2(at(t_.velocity[1]), at(t_.velocity[0])) * 180 / std::numbers::pi;
        return deg < 0 ? deg + 360 : deg;
    }

    const DvlTrack& t_;
    double voltage_;
};

}  // namespace

std::span<const LineForm> line_forms() { return forms; }

std::optional<LineKind> line_kind(std::string_view address) {
    const auto* found = std::ranges::find(formats, address, &Format::address);
    if (found == formats.end()) return std::nullopt;
    return LineKind{&forms[found->form], found->tags};
}

std::string_view line_address(int data_format) {
    const auto* found = std::ranges::find(formats, data_format, &Format::number);
    return found == formats.end() ? std::string_view() : found->address;
}

std::vector<std::string> track_lines(const DvlTrack& track, std::string_view address, double voltage) {
    const auto kind = line_kind(address);
    if (!kind) return {};
    const Numbers numbers(track, voltage);
    std::vector<std::string> lines;
    for (std::size_t beam = 0; beam < (kind->form == &forms[0] ? track.distance.size() : 1); ++beam) {
        std::string body(address);
        for (const LineField& field : kind->form->fields) {
            body += ',';
            if (kind->tags) body += std::string(field.tag) + '=';
            const bool is_text = field.decimals < 0 || field.name == "beam";
            body += is_text ? numbers.text(field.name, beam)
                            : fixed(numbers.number(field.name, *kind->form, beam), field.decimals);
        }
        lines.push_back(nmea::sentence(body));
    }
    return lines;
}

double unix_time(const DvlTrack& t) {
    using namespace std::chrono;
    const auto date = sys_days(year(1900 + t.year) / (t.month + 1) / int{t.day});
    const auto at = date + hours(t.hour) + minutes(t.minute) + seconds(t.second);
    return static_cast<double>(duration_cast<seconds>(at.time_since_epoch()).count()) + 1e-4 * t.fraction;
}

}  // namespace echoloop::nortek
