// What a DVL has to say of a ping and of its position, and how its four outputs write it. Pure functions.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/devices/family/doppler/measurement.h"
#include "emulator/devices/waterlinked-dvl/settings.h"

namespace echoloop::waterlinked_dvl {

/// Of transducers 0 to 3.
struct VelocityReport : doppler::Measured {
    double time = 0;  ///< ms since the report before
    int status = 0;
    std::int64_t validity = 0, transmission = 0;  ///< us, Unix time
};

struct PositionReport {
    double time = 0;  ///< s
    doppler::LocalPosition local;
    int status = 0;
};

/// One line with its end.
std::string json_line(const VelocityReport& report, const Settings& settings);
std::string json_line(const PositionReport& report, const Settings& settings);

/// wrz and four wru.
std::string serial_v2(const VelocityReport& report);
/// wrx and wrt.
std::string serial_v1(const VelocityReport& report);
std::string serial_line(const PositionReport& report);

/// Ten lines.
std::string pd6_lines(const VelocityReport& report, const Settings& settings);
Bytes pd4_block(const VelocityReport& report, const Settings& settings);

/// With at most `decimals` of them and no more than a number needs, as JSON wants it.
std::string number_text(double value, int decimals);
/// "..." with CR LF, or LF.
std::string ended(std::string line, const Settings& settings);

}  // namespace echoloop::waterlinked_dvl
