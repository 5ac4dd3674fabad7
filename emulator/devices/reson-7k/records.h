// The records that a 7k sonar makes of its settings and of one ping. Pure functions; no sockets, no clock.
#pragma once

#include "emulator/devices/reson-7k/ping.h"
#include "protocols/reson7k/codec.h"

namespace echoloop::reson7k_device {

/// What belongs to one ping beside its echogram.
struct PingRecord {
    Controls controls;
    std::uint32_t number = 0;  ///< since power-up, from 1
    double time = 0;           ///< s, Unix, of the end of the transmission
    double since_last = 0;     ///< s
};

/// The frame of a record of this sonar; `unix_time` in s.
reson7k::RecordFrame frame_of(const Settings& settings, double unix_time);

reson7k::SonarSettings make_settings(const PingRecord& ping, const Settings& settings);
/// Ping number 0: on request.
reson7k::RemoteSettings make_remote_settings(const PingRecord& ping, const Settings& settings);
/// 7001: what the sonar is and can, as XML.
reson7k::Configuration make_configuration(const Settings& settings);
reson7k::BeamGeometry make_geometry(const Controls& controls, const Settings& settings);
reson7k::RawDetections make_detections(const PingRecord& ping, const Settings& settings,
                                       const Echogram& echogram);
/// Factor on the power of every bin by the gain and the time-varied gain, at the range that the head reckons
/// with; the amplitude is then a share of full scale.
std::vector<float> gain_curve(const PingRecord& ping, const Settings& settings, const Echogram& echogram);
/// Amplitude 0..1 of full scale. The paper's rule has it already.
float to_share(float power, float gain, bool paper);
inline constexpr float full_scale = 65535;  ///< of amplitudes in 7018 and 7027

reson7k::Image make_image(const PingRecord& ping, const Settings& settings, const Echogram& echogram);
reson7k::Beamformed make_beamformed(const PingRecord& ping, const Settings& settings,
                                    const Echogram& echogram);

reson7k::WaterColumn make_water_column(const PingRecord& ping, const Settings& settings,
                                       const Echogram& echogram);

}  // namespace echoloop::reson7k_device
