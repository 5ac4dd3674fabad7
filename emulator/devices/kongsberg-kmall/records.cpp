#include "emulator/devices/kongsberg-kmall/records.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "emulator/devices/family/survey/sound_speed.h"
#include "emulator/devices/kongsberg-kmall/controls.h"
#include "emulator/devices/kongsberg-kmall/soundings.h"

namespace echoloop::kongsberg_kmall {
namespace {

constexpr double unavailable = 200;  // deg, of latitude and longitude
constexpr double no_salinity = -99;  // of #SVP, where it is not known
constexpr float deepest = 12000;     // m, where every real profile ends

std::string number_text(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Datagrams are multiples of four bytes long; six stand before the text.
std::string padded(std::string text) {
    text.resize((text.size() + 6 + 3) / 4 * 4 - 6);
    return text;
}

std::string line(std::string_view name, const std::string& value) {
    return std::string(name) + ": " + value + '\n';
}

/// A reader that finds no processing unit takes the whole text for broken. Names, type and versions are those
/// of real ones (an EM 2040P with CPU 5.4.0); the serial numbers are as long as theirs, and ours.
std::string processing_unit(const Settings& s) {
    const std::string head = std::to_string(s.head_serial());
    return "PU_0,\nSN=10" + std::to_string(100 + s.system_id) +
           ",\nIP=127.0.0.1:0xff000000,\nUDP=1997,\nTYPE=CON_TECH_PP_B12_SMP_CPU,\n" +
           "VERSIONS:,\nCPU:5.4.0 2022-05-06,\nVXW:6.9 SMP Aug 10 2022,\nVERSIONS-END,\nSERIALno:\nTX:" +
           head + ",\nRX:" + head + ",\nSERIALno-END,\n";
}

std::string extra_detections(const Settings& s) {
    std::string text = line("Extra detection", s.extra_detections > 0 ? "On" : "Off");
    if (s.extra_detections == 0) return text;
    text += "Class   Start  Stop  Quality  Ref.  Conf  Alarm\n";
    for (std::size_t c = 0; c < extra_classes.size(); ++c) {
        char row[96];
        std::snprintf(row, sizeof row, "%zu  Off   %.1f   %.1f   %.1f   %.1f   %.1f   %u\n", c + 1,
                      extra_classes[c].from, extra_classes[c].to, double(worst_quality),
                      double(least_reflectivity), double(least_confidence), unsigned(detections_of_alarm));
        text += row;
    }
    return text;
}

}  // namespace

kmall::Parameters make_installation(kmall::Header header, const Settings& s, double water_level) {
    header.type = "#IIP";
    const std::string model = std::to_string(s.sounder), nowhere = "X=0.000;Y=0.000;Z=0.000;",
                      level = "R=0.000;P=0.000;H=0.000";
    const std::string text =
        "OSCV:Empty,EMXV:EM" + model + ",\n" + processing_unit(s) + "SYSTEM:EM " + model +
        " - Single Tx single Rx,TRAI_TX1:N=1;" + nowhere + level +
        ";S=" + number_text("%.1f", rad_to_deg(s.transmit_beam_width)) + ",TRAI_RX1:N=1;" + nowhere + level +
        ",POSI_1:" + nowhere + "D=0.000;G=WGS84;T=System;C=On;U=ACTIVE,POSI_2:U=NOT_SET,POSI_3:U=NOT_SET," +
        "ATTI_1:" + nowhere + level + ";D=0.000;M=Horizontal;U=ACTIVE,ATTI_2:U=NOT_SET,DPHI:U=NOT_SET," +
        "EMXI:SWLZ=" + number_text("%.3f", water_level) + ",\n";
    return {header, {}, padded(text)};
}

kmall::Parameters make_runtime(kmall::Header header, const Settings& s) {
    header.type = "#IOP";
    const std::string text =
        "\nSector coverage\n" + line("Max angle Port", number_text("%.1f", rad_to_deg(s.port_edge))) +
        line("Max angle Starboard", number_text("%.1f", rad_to_deg(s.starboard_edge))) +
        line("Angular coverage Mode", "Manual") +
        line("Beam spacing", s.equidistant ? "Equidistance" : "Equiangle") + "\nDepth settings\n" +
        line("Max. depth", number_text("%.1f", max_depth(s))) + line("Dual swath", "Off") +
        line("Frequency", number_text("%.0fkHz", s.frequency / 1e3)) + line("FM disable", "On") +
        line("Water column data", s.water_column ? "On" : "Off") + "\nTransmit Control\n" +
        line("Pitch stabilisation", "Off") + line("Max. Ping Freq. (Hz)", number_text("%.2f", s.ping_rate)) +
        line("External Trigger", "Off") + line("Yaw Stabilisation Mode", "Off") +
        "\nSound velocity at Transducer\n" + line("Sound Velocity source", "Probe") + "\nExtra Detections\n" +
        extra_detections(s);
    return {header, {}, padded(text)};
}

kmall::SoundProfile even_profile(const Settings& s) {
    const auto speed = static_cast<float>(s.sound_speed);
    kmall::SoundProfile profile;
    profile.info.format = "S00";
    profile.info.latitude = profile.info.longitude = unavailable;
    profile.points = {{0, speed, 0, 0, 0}, {deepest, speed, 0, 0, 0}};
    if (s.unused_point) profile.surplus.resize(20);
    return profile;
}

kmall::SoundProfile profile_of(const kmall::SoundReading& reading, const Settings& s) {
    const auto f = [](double value) { return static_cast<float>(value); };
    kmall::SoundProfile profile = even_profile(s);
    profile.info.format = reading.format.back() == '0' ? "S00" : "S01";
    profile.info.seconds = reading.seconds;
    profile.info.latitude = reading.latitude.value_or(unavailable);
    profile.info.longitude = reading.longitude.value_or(unavailable);
    profile.points.clear();
    for (const kmall::SoundSample& sample : reading.samples) {
        const double temperature = sample.temperature.value_or(0);
        const double salinity = sample.salinity.value_or(no_salinity);
        const double speed = sample.speed.value_or(survey::sound_speed(temperature, salinity, sample.depth));
        profile.points.push_back({f(sample.depth), f(speed), 0, f(temperature), f(salinity)});
    }
    if (profile.points.back().depth < deepest) {
        profile.points.push_back(profile.points.back());
        profile.points.back().depth = deepest;
    }
    return profile;
}

}  // namespace echoloop::kongsberg_kmall
