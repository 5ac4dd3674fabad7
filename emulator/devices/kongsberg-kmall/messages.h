// What a Kongsberg multibeam tells of a ping: #MRZ and #MWC from its echogram. Pure functions.
#pragma once

#include <optional>
#include <span>

#include "emulator/devices/family/multibeam/bottom.h"
#include "emulator/devices/kongsberg-kmall/ping.h"
#include "protocols/kmall/messages.h"

namespace echoloop::kongsberg_kmall {

/// Bins of the echogram that one sample of the water column averages.
inline constexpr std::size_t bins_per_sample = 4;

struct PingRecord {
    std::uint16_t number = 0;
    double time = 0;    ///< s, Unix time of the transmission
    double period = 0;  ///< s since the last one; 0: it is the first
    double heave = 0;   ///< m, of the head, downwards
};

kmall::Mrz make_mrz(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
                    std::span<const multibeam::Detection> detections);
kmall::Mwc make_mwc(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
                    std::span<const multibeam::Detection> detections);

/// #CHE, which comes before a water column.
kmall::PingHeave make_heave(const PingRecord& ping, const Settings& settings);

/// z of the valid sounding nearest the vertical, m below the head.
std::optional<double> depth_below(const kmall::Mrz& bathymetry);

/// What both begin with.
kmall::Header make_header(const PingRecord& ping, const Settings& settings, const char* type,
                          std::uint8_t version);
kmall::Body make_body(const PingRecord& ping);
/// Time-varied gain at slant range `r` m with X = `x`, dB; 0 if the effect is off.
double gain(const Settings& settings, double x, double r);

}  // namespace echoloop::kongsberg_kmall
