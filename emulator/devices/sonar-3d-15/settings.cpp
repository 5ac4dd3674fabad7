#include "emulator/devices/sonar-3d-15/settings.h"

#include <stdexcept>

#include "emulator/contract/random_key.h"

namespace echoloop::sonar_3d_15 {
namespace {

const char* const spec = "Sonar 3D-15 specification notes";
const char* const maker = "maker's documentation (github.com/waterlinked/docs)";
const char* const own = "own choice";

void describe_start(State& s, OptionList& o) {
    o.flag(s.enabled, "acoustics", "pings and images from the start, before a host has enabled them", maker);
    o.choice(s.high, "mode", {"low-frequency", "high-frequency"}, "at the start", own);
    o.number(s.range_min, "range_min", "m", 0, 100, "at the start", spec);
    o.number(s.range_max, "range_max", "m", 0.1, 100, "at the start; the profile says the longest", spec);
    o.number(s.speed, "speed_of_sound", "m/s", 0, 2000, "at the start; 0: from salinity and temperature",
             spec);
    o.words(s.salt, "salinity", {{"salt", true}, {"fresh", false}},
            "at the start, for the automatic speed of sound", own);
    o.words(s.udp, "udp", {{"multicast", UdpMode::multicast}, {"disabled", UdpMode::disabled}},
            "where images go at the start, unless a second endpoint sets unicast", spec);
}

void describe_answers(Settings& s, OptionList& o) {
    using sonar3d::Version;
    o.words(s.release, "release",
            {{"1.8.0", with_imu},
             {"1.7.1", with_time},
             {"1.7.0", with_modes},
             {"1.6.0", {1, 6, 0}},
             {"1.5.1", {1, 5, 1}}},
            "of the firmware; status, mode and salinity came with 1.7.0, time with 1.7.1, the IMU with 1.8.0",
            "maker's Python client");
    o.words(s.ntp_reached, "ntp", {{"synchronised", true}, {"unreachable", false}},
            "from release 1.7.1 on: the clock is right, or begins in the past until a host sets it", maker);
    o.flag(s.start.imu, "imu", "sends ImuBatch from the start; from release 1.8.0 on", own);
    o.words(s.version, "packets", {{"RIP2", Version::rip2}, {"RIP1", Version::rip1}},
            "RIP1 is not compressed; older firmware sends it", spec);
    o.choice(s.package, "package", {"waterlinked.sonar.protocol", "waterlinked.rip1"},
             "of the protobuf messages", spec);
    o.choice(s.frequency_in_hertz, "frequency_field", {"5", "hertz"},
             "in images: as a real sonar sends it, or as documented", spec);
    o.choice(s.first_row_up, "first_row", {"down", "up"}, "where row 0 looks", spec);
    o.flag(s.any_page, "any_page",
           "HTTP answers web pages from elsewhere, and under any host name, as the real sonar does", own);
    o.flag(s.other_messages, "other_messages",
           "a message of an undocumented type follows the images of each shot; readers must skip it", spec);
    o.number(s.temperature, "temperature", "degC", -20, 100, "inside the sonar", spec);
    o.number(s.water_temperature, "water_temperature", "degC", -4, 40, "for the automatic speed of sound",
             own);
    o.number(s.speed_delay, "speed_delay", "s", 0, 120,
             "until a new speed of sound is used; real units take 20", spec);
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the last echo to the image, at least",
             "own choice: short of the pauses that the maker's rates leave");
}

void describe_mode(ModeFigures& m, const std::string& mode, FigureList& f) {
    f.number(m.frequency, mode + "_frequency", "Hz", 100e3, 10e6, "centre frequency");
    f.degrees(m.beam_width, mode + "_beam_width", 0.05, 10, "of one beam, -3 dB full width");
    f.degrees(m.fan_height, mode + "_fan_height", 0.05, 20, "of one beam, -3 dB full height");
    f.degrees(m.fov_horizontal, mode + "_fov_horizontal", 5, 120,
              "between the centres of the outer pixels of a row");
    f.degrees(m.fov_vertical, mode + "_fov_vertical", 5, 60,
              "between the centres of the first and the last row");
    f.number(m.rate, mode + "_rate", "Hz", 0.1, 40, "images a second, if the range allows it");
    f.number(m.source_level, mode + "_source_level", "dB re 1 uPa at 1 m", 100, 240, "all over the view");
    f.number(m.tvg_absorption, mode + "_tvg_absorption", "dB/m", 0, 10, "time-varied gain, one way");
}

void describe_profile(Acoustics& a, FigureList& f) {
    f.number(a.pulse_length, "pulse_length", "s", 1e-6, 1e-2, "of the chirp");
    f.number(a.longest_range, "longest_range", "m", 1, 100, "that can be set");
    f.number(a.finest_bin, "finest_bin", "m", 0.001, 1, "of range, before the peak is interpolated");
    f.whole(a.bins, "bins", 16, 2048, "of range, the most");
    f.number(a.detection, "detection_level", "dB", 0, 60, "how far above the noise an echo must be to count");
    f.number(a.neighbours, "neighbour_level", "dB", 0, 120,
             "how far below the mean of 10 beams to either side an echo may lie and still count");
    f.number(a.high.directivity_index, "high_directivity_index", "dB", 0, 60,
             "of the receiver in the high mode; directivity_index is the low one");
    f.number(a.reference_level, "reference_level", "dB re 1 uPa", 0, 300, "reads strength 0 at 1 m");
    f.number(a.tvg_spreading, "tvg_spreading", "dB per decade of range", 0, 60, "time-varied gain");
    describe_mode(a.low, "low", f);
    describe_mode(a.high, "high", f);
    f.common(a.horizontal, a.vertical, a.receiver);
    a.low.directivity_index = a.receiver.directivity_index;
}

void check(const State& s, const Acoustics& a) {
    if (s.range_min >= s.range_max || s.range_max > a.longest_range)
        throw std::invalid_argument("options range_min and range_max must ascend and end within " +
                                    std::to_string(a.longest_range) + " m");
    if (s.speed != 0 && s.speed < 1000)
        throw std::invalid_argument("option speed_of_sound must be 0 (automatic) or 1000 to 2000 m/s");
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_start(s.start, o);
    describe_answers(s, o);
    describe_profile(s.acoustics, f);
}

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    check(s.start, s.acoustics);
    s.tvg = config.effects.has(Effect::tvg);
    s.unix_start = config.unix_start;
    s.chip_id = static_cast<std::uint32_t>(split_mix(config.random_key));
    return s;
}

}  // namespace echoloop::sonar_3d_15
