// The options of each altimeter as typed values. Data only.
#pragma once

#include <string>
#include <type_traits>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/family/sounder/sounding.h"
#include "protocols/altimeter/line.h"

namespace echoloop::altimeters {

using echosounder::Sounding;

/// Valeport VA500.
struct Valeport {
    enum class Format { nmea, sddbt, tritec, benthos };
    enum class NoBottom { zero, text, last, silent };
    enum class Pressure { sensor, zeros, none };

    Sounding sounding{.rate = 1, .range = 100, .baud = 115200};
    Format format = Format::nmea;
    NoBottom no_bottom = NoBottom::zero;
    Pressure pressure = Pressure::sensor;
    bool running = true;  ///< at power-up
    std::string error_text = "ERROR";
    std::string serial = "41873";
};
void describe(Valeport& settings, OptionList& options, FigureList& figures);

/// Tritech PA200 and PA500.
struct Tritech {
    Sounding sounding{.rate = 10, .range = 50, .baud = 9600};
    int switches = 5;
    bool point = true;  ///< false: centimetres without a point

    /// What the switches say.
    bool addressed() const { return switches >= 32; }
    char letter() const { return addressed() ? static_cast<char>('A' + switches % 8) : '\0'; }
    bool nmea() const { return switches == 17 || switches == 18; }
    bool free_running() const { return nmea() || (!addressed() && switches % 2 == 1); }
    bool maximum() const { return switches == 18 || (addressed() ? switches >= 40 : (switches & 2) != 0); }
    altimeter::Format format() const;
};
void describe(Tritech& settings, OptionList& options, FigureList& figures);

/// Benthos PSA-916.
struct Benthos {
    Sounding sounding{.rate = 5, .range = 99.99, .baud = 9600};
    bool previous = true;   ///< a missed ping says the last distance
    double nearest = 0.80;  ///< m
};
void describe(Benthos& settings, OptionList& options, FigureList& figures);

/// Echologger ECT400 and its family.
struct Echologger {
    Sounding sounding{.rate = 1, .range = 10, .baud = 115200};
    bool nmea = true;
    double dead_zone = 0;  ///< m
    double offset = 0;     ///< m
    double temperature = 10;
};
void describe(Echologger& settings, OptionList& options, FigureList& figures);

/// Imagenex 863.
struct Imagenex {
    Sounding sounding{.rate = 1, .range = 49, .baud = 2400};
};
void describe(Imagenex& settings, OptionList& options, FigureList& figures);

struct TritechPa200 : Tritech {
    TritechPa200() { sounding.rate = 7, sounding.range = 100; }
};
/// std::invalid_argument if the number means nothing.
void check_switches(int switches);

/// From complete options and a complete profile; std::invalid_argument if an option is none of the device's.
template <class Settings>
Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    s.sounding.baud = line_rate(config.endpoints, s.sounding.baud);
    s.sounding.sensors = Sensors(config.random_key, config.effects);
    if constexpr (std::is_base_of_v<Tritech, Settings>) check_switches(s.switches);
    return s;
}

}  // namespace echoloop::altimeters
