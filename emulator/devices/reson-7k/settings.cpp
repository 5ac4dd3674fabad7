#include "emulator/devices/reson-7k/settings.h"

namespace echoloop::reson7k_device {
namespace {

const char* const spec = "Reson 7k specification notes";
const char* const own = "own choice";

void describe(Controls& c, OptionList& o) {
    o.number(c.range, "range", "m", 1, 500, "1003 at power-up", own);
    o.number(c.max_rate, "max_ping_rate", "Hz", 0.1, 50, "1004 at power-up", own);
    o.number(c.power, "power", "dB re 1 uPa at 1 m", 170, 220, "1005 at power-up", own);
    o.number(c.pulse, "pulse", "s", 30e-6, 300e-6, "1006 at power-up", own);
    o.number(c.gain, "gain", "dB", 0, 83, "1008 at power-up", own);
    o.flag(c.pinging, "pinging", "pings from power-up on, as after 1100", own);
}

void describe(Settings& s, OptionList& o) {
    o.whole(s.device, "device", "", 1, 65535, "device id in the records; commands must name it", spec);
    o.whole(s.serial, "serial", "", 0, 4294967295.0, "of the sonar", own);
    o.whole(s.beams, "beams", "", 16, 512, "of the swath, in equal steps of angle", own);
    o.degrees(s.swath, "swath", 10, 160, "from the first to the last beam", own);
    describe(s.start, o);
    o.choice(s.any_device, "command_device", {"own", "any"},
             "device id that commands must carry; subscriptions and requests may name 7000 too", spec);
    o.choice(s.ends_by_third_party, "end_subscriptions", {"1052", "1053"},
             "command that ends all subscriptions: 1052 as in the command table, or 1053 (without an "
             "address) as in the introduction",
             spec);
    o.number(s.datagram_gap, "datagram_gap", "s", 0, 0.1,
             "pause between the datagrams of a ping; shorter if the next ping would come before they are out",
             "receivers with default buffers lose faster bursts");
    o.number(s.processing_time, "processing_time", "s", 0, 1, "from the last echo to the records",
             "own choice: from the last echo to the records");
}

void describe_head(Acoustics& a, FigureList& f) {
    f.number(a.frequency, "frequency", "Hz", 10e3, 1e6,
             "centre frequency at power-up, at which beam widths are given");
    f.number(a.least_frequency, "least_frequency", "Hz", 10e3, 1e6, "that can be set");
    f.number(a.most_frequency, "most_frequency", "Hz", 10e3, 1e6, "that can be set");
    f.number(a.sample_rate, "sample_rate", "Hz", 1e3, 1e6, "of the samples that detections count");
    f.degrees(a.receive_beam_width, "receive_beam_width", 0.1, 10, "of one beam across the track, -3 dB");
    f.degrees(a.transmit_beam_width, "transmit_beam_width", 0.1, 30, "along the track, -3 dB");
    f.degrees(a.receive_fan, "receive_fan", 0.1, 90,
              "of one receive beam along the track, -3 dB; reported only");
    f.degrees(a.transmit_sector, "transmit_sector", 10, 180, "across the track, -3 dB; reported only");
    f.number(a.receiver.bandwidth, "receiver_bandwidth", "Hz", 1e3, 1e6, "for noise and the shape of echoes");
    f.number(a.least_range, "least_range", "m", 0.5, 100, "that can be set");
    f.number(a.most_range, "most_range", "m", 10, 2000, "that can be set");
    f.number(a.least_power, "least_power", "dB re 1 uPa at 1 m", 100, 240, "that can be set");
    f.number(a.most_power, "most_power", "dB re 1 uPa at 1 m", 100, 240, "that can be set");
    f.number(a.least_pulse, "least_pulse", "s", 1e-6, 1e-2, "that can be set");
    f.number(a.most_pulse, "most_pulse", "s", 1e-6, 1e-2, "that can be set");
    f.number(a.most_gain, "most_gain", "dB", 0, 120, "that can be set");
    f.number(a.most_rate, "most_rate", "Hz", 1, 100, "that can be set");
}

void describe_levels(Acoustics& a, std::uint64_t serial, FigureList& f) {
    f.number(a.ping_pause, "ping_pause", "s", 0, 1, "from the end of the range to the next ping");
    f.number(a.spreading, "tvg_spreading", "dB per decade of range", 0, 60, "time-varied gain");
    f.number(a.absorption, "tvg_absorption", "dB/km", 0, 500, "time-varied gain, one way");
    f.number(a.amplitude_reference, "amplitude_reference", "dB re 1 uPa", 0, 400,
             "after gain and time-varied gain: reads full scale");
    multibeam::list_figures(a.detection, f);
    f.common(a.horizontal, a.vertical, a.receiver);
    f.stave_errors(a.errors, std::to_string(serial));
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f) {
    describe(s, o);
    describe_head(s.acoustics, f);
    describe_levels(s.acoustics, s.serial, f);
}

Settings read_settings(const DeviceConfig& config) {
    auto s = fill_settings<Settings>(config);
    s.start.frequency = s.acoustics.frequency;
    s.start.absorption = s.acoustics.absorption;
    s.start.spreading = s.acoustics.spreading;
    s.start.sound_speed = config.sound_speed;
    s.tvg = config.effects.has(Effect::tvg);
    s.pulse = config.effects.has(Effect::pulse);
    s.unix_start = config.unix_start;
    if (config.origin) s.origin = *config.origin;
    return s;
}

}  // namespace echoloop::reson7k_device
