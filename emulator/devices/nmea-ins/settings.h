// The options and figures of a navigation unit as typed values. Data only.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/contract/settings_list.h"
#include "emulator/devices/family/survey/motion_unit.h"

namespace echoloop::nmea_ins {

enum class Word { gga, zda, vtg, hdt, pashr, tss1, em3000 };

struct WordRow {
    std::string_view name;    ///< as the option `ports` writes it
    std::string_view option;  ///< its rate
    double rate;              ///< Hz, by default
    double bytes;             ///< the most that it may have
};
/// In the order of Word.
inline constexpr std::array<WordRow, 7> words{{{"GGA", "gga", 1, 92},
                                               {"ZDA", "zda", 1, 37},
                                               {"VTG", "vtg", 1, 50},
                                               {"HDT", "hdt", 10, 18},
                                               {"PASHR", "pashr", 10, 80},
                                               {"TSS1", "tss1", 50, 27},
                                               {"EM3000", "em3000", 100, 10}}};

struct Settings {
    Settings() {
        for (std::size_t i = 0; i < words.size(); ++i) rates[i] = words[i].rate;
    }

    Sensors sensors;
    survey::Strays strays;
    std::string talker = "IN";
    std::array<double, words.size()> rates{};  ///< Hz; 0: it is not said
    std::vector<std::vector<Word>> ports;      ///< what goes to each endpoint
    double baud = 115200;                      ///< bit/s
    double latency = 0.005;                    ///< s, from a moment to the first byte about it
    double time_error = 0;                     ///< s, added to all time stamps
    double latitude = 0, longitude = 0;        ///< deg, of the scene's origin
    double height = 0;                         ///< m, of the scene's origin
    double unix_start = 0;                     ///< s
};

/// From complete options and a complete profile; std::invalid_argument if options contradict each other or a
/// line is too slow for what it is to carry.
Settings read_settings(const DeviceConfig& config);
void describe(Settings& settings, OptionList& options, FigureList& figures);

}  // namespace echoloop::nmea_ins
