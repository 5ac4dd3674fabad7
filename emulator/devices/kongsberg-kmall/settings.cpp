#include "emulator/devices/kongsberg-kmall/settings.h"

#include <cmath>
#include <utility>

namespace echoloop::kongsberg_kmall {
namespace {

const char* const notes = "specification notes on KMALL";
const char* const own = "own choice";

void describe_start(Settings& s, OptionList& o) {
    o.flag(s.pinging, "pinging", "pings from power-up; the text 458 starts it, 457 stops it",
           "own choice, so that a first run shows a bottom");
    o.flag(s.water_column, "water_column", "#MWC at power-up; the text 461 switches it on, 460 off", own);
    o.number(s.range, "range", "m", 2, 600, "how far it listens", own);
    o.number(s.frequency, "frequency", "Hz", 200e3, 400e3, "frequency mode",
             "maker's names of the EM 2040's modes: 200, 300, 400 kHz");
    o.number(s.pulse, "pulse", "s", 25e-6, 600e-6, "CW pulse length", own);
    o.number(s.power, "power", "dB", -40, 0, "relative to full power", own);
    double sector_width = deg_to_rad(120);
    o.degrees(sector_width, "sector_width", 10, 150, "of the fan", own);
    s.port_edge = s.starboard_edge = sector_width / 2;
    o.whole(s.soundings, "soundings", "", 16, 512, "beams of a ping", "two real #MRZ datagrams: 400");
    o.choice(s.equidistant, "beam_spacing", {"equiangle", "equidistant"}, "on a flat floor", notes);
    o.number(s.ping_rate, "ping_rate", "Hz", 0.1, 50, "upper limit", own);
}

void describe_words(Settings& s, OptionList& o) {
    double absorption = 70;
    o.number(absorption, "absorption", "dB/km", 0, 300, "that the sounder assumes in its gain", own);
    s.absorption = absorption / 1000;
    o.words(s.version, "mrz_version", {{"3", 3}, {"2", 2}, {"1", 1}, {"0", 0}},
            "of #MRZ: 152 bytes of ping info, version 0 has 144",
            "3 in 81 of 81 datagrams of two real systems");
    o.flag(s.seabed_image, "seabed_image", "#MRZ has samples of the bottom around each sounding",
           "datagrams of two real systems");
    o.whole(s.extra_detections, "extra_detections", "", 0, 512,
            "soundings of what is strongest beside the bottom, at most; 0: none",
            "76 to 117 in a real system that has them on, which is its operator's choice");
    o.whole(s.largest_part, "largest_part", "B", 1000, 65507, "a longer #MRZ or #MWC goes out in parts",
            "specification notes: above 64 kB; where it is cut is our own choice");
    o.flag(s.unused_point, "unused_point", "20 bytes of zeros behind the points that #SVP counts",
           "22 of 22 real datagrams");
    o.flag(s.sensor_datagrams, "sensor_datagrams",
           "#SPO, #CPO, #SPE, #SCL and #SVT twice a second, #SKM with 102 samples of motion at 100 Hz, and "
           "#CHE before "
           "a water column",
           "files of an EM 2042; an EM 2040P tells its position five times a second");
    o.choice(
        s.later_profiles, "later_profiles", {"stored", "used", "refused"},
        "what becomes of the texts S10 to S12, which wait for the operator's consent; S00 to S02 are used",
        "inferred from public senders");
    o.whole(s.sounder, "sounder", "", 1, 65535,
            "number of the echo sounder; commands must name it: EM2040_40, EM2040 or 2040", notes);
    o.whole(s.system_id, "system_id", "", 0, 255,
            "distinguishes sounders of the same number; ends the sounder's name",
            "default of a known driver: EM2040_40");
    o.number(s.latitude, "latitude", "deg", -89, 89,
             "of the scene's origin; where both are 0, as the scene says", own);
    o.number(s.longitude, "longitude", "deg", -180, 180, "of the scene's origin", own);
    o.choice(s.values_as_xml, "values_text", {"401", "814"},
             "number of the text that answers 261 and 262: 401 is JSON, 814 is the XML of later controllers",
             "401: a known driver's list of texts; 814: its code");
    o.number(s.datagram_gap, "datagram_gap", "s", 0, 0.1, "pause between the parts of a water column",
             "own choice: receivers with default buffers lose faster bursts");
    o.number(
        s.probe_interval, "probe_interval", "s", 0.02, 60, "from one sound speed at the head to the next",
        "files of an EM 2042: five values in 5 pings within 4 s; an EM 2040P has one in 25 pings within 1 s");
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the last echo to the datagrams", own);
}

void describe_profile(Settings& s, FigureList& f) {
    f.number(s.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 260, "at full power");
    f.number(s.reference_frequency, "reference_frequency", "Hz", 10e3, 10e6,
             "at which beam widths and directivity index are given");
    f.degrees(s.receive_beam_width, "receive_beam_width", 0.05, 20, "-3 dB full width across track, one way");
    f.degrees(s.transmit_beam_width, "transmit_beam_width", 0.05, 20,
              "-3 dB full width along track, one way");
    f.number(s.water_column_reference, "water_column_reference", "dB re 1 uPa", 0, 300,
             "level after gain and its offset that reads 0 dB in #MWC");
    multibeam::list_figures(s.detection, f);
    f.common(s.horizontal, s.vertical, s.receiver);
    f.stave_errors(s.errors, std::to_string(s.head_serial()));
}

}  // namespace

void Settings::tune(double hertz) {
    const double ratio = std::exchange(frequency, hertz) / hertz;
    receive_beam_width *= ratio;
    transmit_beam_width *= ratio;
    receiver.directivity_index -= 20 * std::log10(ratio);
}

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe_start(s, o);
    describe_words(s, o);
    describe_profile(s, f);
}

Settings read_settings(const DeviceConfig& config) {
    Settings s = fill_settings<Settings>(config);
    s.tune(std::exchange(s.frequency, s.reference_frequency));
    s.tvg = config.effects.has(Effect::tvg);
    s.echoes_last = config.effects.has(Effect::pulse);
    s.sound_speed = config.sound_speed;
    s.unix_start = config.unix_start;
    if (config.origin && s.latitude == 0 && s.longitude == 0)
        s.latitude = config.origin->latitude, s.longitude = config.origin->longitude;
    return s;
}

}  // namespace echoloop::kongsberg_kmall
