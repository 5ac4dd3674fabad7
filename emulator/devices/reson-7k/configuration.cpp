// Record 7001: XML in the words of a real one, as far as their values are known here. Drivers look for the
// device to talk to in its element Name.
#include <cstdio>
#include <string>

#include "emulator/devices/reson-7k/records.h"

namespace echoloop::reson7k_device {
namespace {

std::string attribute(const char* name, const std::string& text) {
    return std::string(" ") + name + "=\"" + text + '"';
}
std::string attribute(const char* name, double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.10g", value);
    return attribute(name, digits);
}

std::string element(const std::string& name, const std::string& attributes, const std::string& text) {
    return "  <" + name + attributes + '>' + text + "</" + name + ">\r\n";
}

/// What can be set, from `low` to `high`.
std::string bounds(const char* name, double low, double high, const char* unit, const char* text) {
    return element(name, attribute("min", low) + attribute("max", high) + attribute("unit", unit), text);
}

std::string identity(const Settings& s) {
    const std::string device = std::to_string(s.device);
    const long khz = std::lround(s.acoustics.frequency / 1e3);
    return element("Name", attribute("deviceid", device) + attribute("enumerator", "0"),
                   device + " (" + std::to_string(khz) + "kHz)") +
           element("SystemInfo", attribute("auv", "no") + attribute("name", device), device + " Sonar") +
           element("SonarType", attribute("type", "0") + attribute("unit", "nb"), "Bathymetric sonar");
}

std::string beams(const Settings& s) {
    const Acoustics& a = s.acoustics;
    const double coverage = rad_to_deg(s.swath), along = a.transmit_beam_width, across = a.transmit_sector;
    const std::string mode = attribute("max_beams", std::to_string(s.beams)) +
                             attribute("beam_spacing", "EA") + attribute("min_coverage", coverage) +
                             attribute("max_coverage", coverage);
    return element("RxBeamWidth",
                   attribute("uniformacross", "yes") + attribute("uniformalong", "yes") +
                       attribute("across", a.receive_beam_width) + attribute("along", a.receive_fan) +
                       attribute("unit", "rad"),
                   "Receiver beamwidth") +
           "  <RxBeamModeSet>\r\n  " + element("RxBeamMode", mode, "Equi-Angle") + "  </RxBeamModeSet>\r\n" +
           element("TxBeamWidth",
                   attribute("variable", "no") + attribute("maxx", along) + attribute("minx", along) +
                       attribute("maxz", across) + attribute("minz", across) + attribute("unit", "rad"),
                   "Transmit beamwidth");
}

std::string limits(const Acoustics& a) {
    return bounds("TxPulseLength", a.least_pulse, a.most_pulse, "s", "Transmit pulse length") +
           element("Frequency",
                   attribute("chirp", "no") + attribute("min", a.least_frequency) +
                       attribute("max", a.most_frequency) + attribute("center", a.frequency) +
                       attribute("unit", "hz"),
                   "Transmit frequency") +
           element("SampleRate", attribute("rate", a.sample_rate) + attribute("unit", "hz"),
                   "Receiver sample rate") +
           bounds("Power", a.least_power, a.most_power, "dB//uPa", "Transmit power") +
           bounds("Gain", 0, a.most_gain, "dB", "Receiver gain") +
           bounds("Range", a.least_range, a.most_range, "m", "Operating range") +
           bounds("PingRate", 0, a.most_rate, "p/s", "Ping rate") +
           element("BottomDetection", attribute("method", "G2"), "BD Method");
}

/// As of a real one: serial number and four digits, each behind a 0. What these mean is not known.
std::string description_of(const Settings& settings) {
    std::string text = "SN" + std::to_string(settings.serial);
    for (const char* digit : {"1", "0", "3", "3"}) text += '\0', text += digit;
    return text;
}

}  // namespace

reson7k::Configuration make_configuration(const Settings& settings) {
    const std::string root = "SB" + std::to_string(settings.device);
    const std::string xml = "<?xml version=\"1.0\" encoding=\"us-ascii\"?>\r\n<" + root + ">\r\n" +
                            identity(settings) + beams(settings) + limits(settings.acoustics) + "</" + root +
                            ">\r\n";
    reson7k::Configuration c;
    c.serial = c.device_serial = settings.serial;
    c.device = settings.device;
    c.description = std::string_view(description_of(settings));
    c.info.assign(xml.begin(), xml.end());
    c.info.push_back(0);
    return c;
}

}  // namespace echoloop::reson7k_device
