// The soundings of #MRZ: what each beam has found, and where that lies. Pure functions.
#pragma once

#include <array>
#include <span>

#include "emulator/devices/family/multibeam/bottom.h"
#include "emulator/devices/kongsberg-kmall/ping.h"
#include "protocols/kmall/messages.h"

namespace echoloop::kongsberg_kmall {

inline float f(double value) { return static_cast<float>(value); }
inline bool is_valid(const kmall::Sounding& sounding) { return sounding.type == 0; }

/// Metres to starboard to degrees of longitude, and so on; on a sphere whose minutes are 1852 m (own choice).
struct Degrees {
    double latitude = 0, longitude = 0;
};
Degrees degrees_of(double east, double north, const Settings& settings);

/// What is known of every beam: one that found nothing. `direction`: where it looks, in the surface's frame.
kmall::Sounding beam(const Settings& settings, std::size_t index, double bearing, Vec3 direction);
/// A bottom at it.
void add_bottom(kmall::Sounding& sounding, const multibeam::Detection& detection, double sample_rate);
/// Where it lies, m from the head. `contrast`: peak over mean of the echo, which its quality follows.
void add_place(kmall::Sounding& sounding, Vec3 place, const Surface& surface, const Settings& settings,
               double contrast);
/// Soundings without a bottom get a place, too, as in the files of real heads: where the bottom of the others
/// goes on. Not those that look along the surface or up.
void place_rejected(kmall::Mrz& mrz, std::span<const Vec3> directions, const Surface& surface,
                    const Settings& settings);

/// Classes of extra detections, by their range in % of the bottom's in their beam, and what one of a class
/// must have; all as an EM 2040P's #IOP tells them, and as 2384 extra detections of its #MRZ hold to.
struct ExtraClass {
    double from = 0, to = 0;
};
inline constexpr std::array<ExtraClass, 7> extra_classes{
    {{5, 10}, {10, 30}, {30, 60}, {60, 90}, {90, 100}, {100, 110}, {110, 200}}};
inline constexpr std::uint8_t least_confidence = 10;
inline constexpr float least_reflectivity = -60, worst_quality = 1;  // dB, %
inline constexpr std::uint16_t detections_of_alarm = 5;

/// The echoes that stand out most beside the bottom, one of a beam, as many as the settings say, behind the
/// soundings of the bottom.
void add_extra_detections(kmall::Mrz& mrz, const Settings& settings, const Echogram& echogram,
                          std::span<const multibeam::Detection> detections);
/// Gives each its class, counts them and rings the alarms; when their reflectivities are known. What fits no
/// class stands in one more, behind the seven.
void classify_extra_detections(kmall::Mrz& mrz);

}  // namespace echoloop::kongsberg_kmall
