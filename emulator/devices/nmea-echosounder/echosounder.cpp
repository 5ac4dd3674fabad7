#include "emulator/devices/nmea-echosounder/echosounder.h"

namespace echoloop::nmea_echosounder {
namespace {

std::string sentence(const Settings& settings, const std::string& formatter, nmea::Depth depth, Time now) {
    if (formatter == "MTW") {
        const double water =
            settings.sounding.sensors.read("water", settings.temperature, stray::water_temperature, now);
        return nmea::mtw(water, settings.style);
    }
    if (formatter == "DPT") {
        const auto range = settings.range_in_dpt ? std::optional(settings.sounding.range) : std::nullopt;
        return nmea::dpt(depth, settings.offset, range, settings.style);
    }
    // The offset's sign says whether it leads up to the surface (DBS) or down to the keel (DBK).
    if (formatter != "DBT" && depth) depth = *depth + settings.offset;
    return nmea::depth_below(formatter, depth, settings.style);
}

}  // namespace

std::vector<std::string> sentences(const Settings& settings, nmea::Depth depth, Time now) {
    std::vector<std::string> all;
    for (const std::string& formatter : settings.sentences)
        if (depth || !settings.silent_without_bottom || formatter == "MTW")
            all.push_back(sentence(settings, formatter, depth, now));
    return all;
}

}  // namespace echoloop::nmea_echosounder
