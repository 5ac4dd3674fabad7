#include "emulator/devices/r2sonic/settings.h"

#include <stdexcept>

namespace echoloop::r2sonic_device {
namespace {

const char* const manual = "operation manual, control commands";
const char* const example = "operation manual, example start values";

wire::Text<12> serial_number(const std::string& text) {
    if (text.size() > 12)
        throw std::invalid_argument("serial number '" + text + "' is longer than 12 characters");
    return std::string_view(text);
}

/// What commands change, as it is at power-up.
void describe(Controls& c, OptionList& o, const Variant& variant) {
    o.choice(c.trigger, "trigger", {"free", "external", "command"}, "TRG0 at power-up", example);
    o.number(c.range, "range", "m", 2, 1200, "RNG0 at power-up", example);
    o.number(c.frequency, "frequency", "Hz", 90e3, 700e3, "FRQ0 at power-up", example);
    o.number(c.power, "power", "dB re 1 uPa at 1 m", 0, 221, "TXP0 at power-up; 0 transmits nothing",
             example);
    o.number(c.pulse, "pulse", "s", 10e-6, variant.longest_pulse, "TXL0 at power-up", example);
    o.number(c.gain, "gain", "half dB", 1, 45, "GAN0 at power-up; times 2 is dB", example);
    o.number(c.spreading, "spreading", "dB per decade of range", 0, 60, "SPR0 at power-up", example);
    o.number(c.absorption, "absorption", "dB/km", 0, 200, "ABS0 at power-up", example);
    double ping_rate = 0;
    o.number(ping_rate, "ping_rate", "Hz", 0, 60,
             "upper limit of the ping rate at power-up; 0: none (PRU0 = 0)", example);
    c.limit_ping_rate = ping_rate > 0;
    if (c.limit_ping_rate) c.ping_rate = ping_rate;
    o.degrees(c.sector_width, "sector_width", 10, rad_to_deg(variant.widest_sector), "SEW0 at power-up",
              example);
    o.degrees(c.sector_rotation, "sector_rotation", -70, 70, "SER0 at power-up, positive to starboard",
              example);
    o.choice(c.equi_distant, "bottom_mode", {"equi-angle", "equi-distant"}, "BOS0 at power-up", example);
    o.flag(c.intensity, "intensity", "BIE0 at power-up: BTH0 carries intensities", example);
    o.whole(c.image_height, "image_height", "bins", 0, 4096,
            "AIH0 at power-up: upper limit of range bins in AID0; 0: no image", example);
    o.number(c.image_brightness, "image_brightness", "dB", 0, 60, "AIB0 at power-up", example);
    o.words(c.projector, "projector", {{"narrow", 1}, {"wide", 2}},
            "PROJ at power-up: narrow 1 deg, wide 20 deg (forward looking)", example);
    o.choice(c.water_column, "water_column", {"off", "magnitude", "phase"}, "WCM0 at power-up", example);
    o.flag(c.snippets, "snippets", "SNIP at power-up", example);
    o.choice(c.truepix, "truepix", {"off", "magnitude", "direction"}, "TPM0 at power-up", example);
}

/// What no command changes.
void describe_wire(Settings& s, OptionList& o) {
    std::string serial = "100017", sim_serial = "100117";
    o.text(serial, "serial", "serial number of the head, at most 12 characters", "manual's example");
    o.text(sim_serial, "sim_serial", "serial number of the SIM, at most 12 characters", "manual's example");
    s.serial = serial_number(serial);
    s.sim_serial = serial_number(sim_serial);
    o.number(s.datagram_gap, "datagram_gap", "s", 0, 0.1, "time for each datagram of one image",
             "receivers with default buffers lose faster ones; those of a millisecond leave together");
    o.choice(s.discovery, "discovery_reply", {"sender", "gui", "none"}, "where R2DI goes", manual);
    o.choice(
        s.test_bits, "quality_bits", {"tests", "set", "clear"},
        "bits 1 and 0 of Q0 of good points: by the tests of colinearity and brightness, always set, or clear",
        "manual v3.0; set in all real pings; reserved in v5.0 and v6.3");
    o.flag(s.verbose_gates, "verbose_gates", "BTH0 carries the gate of every beam (G1)", manual);
    o.choice(s.bins_first, "image_order", {"beams", "bins"},
             "what comes first in the data of AID0: all bins of a beam, or all beams of a bin",
             "known readers; earlier versions of them read bins first");
    o.choice(s.old_truepix_header, "truepix_header", {"v6.3", "v5.0"},
             "bytes 108 to 115 of TPX0's H0: reserved, or with the transmit voltage offset",
             "manuals of these versions");
    o.choice(s.configured_hosts, "data_hosts", {"gui", "configured"},
             "where water column, snippets and TruePix go: to the host, or to R2DC's data acquisition hosts "
             "(the first gets TruePix and snippets, the second the water column)",
             "normally the host itself; the order of the others is an own choice");
    o.whole(s.mode_sets, "multimode_sets", "", 0, 4,
            "number of MultiMode sets (ABS1, FRQ1, ...) that the pings cycle through; 0: none",
            "manual; the command that starts it is not public");
    o.number(s.sync_in, "sync_in", "Hz", 0, 60, "pulses at the SIM's sync input, for TRG0 = 1; 0: none",
             "own choice");
    o.number(s.processing_time, "processing_time", "s", 0, 1,
             "from the last sample to the first datagram of the products, and to the next ping",
             "own choice");
    o.number(s.bathymetry_time, "bathymetry_time", "s", 0, 1,
             "from the last sample to BTH0, not before the products", "a recorded 2022: 10.8 to 11.5 ms");
}

void describe(Acoustics& a, std::string_view serial, FigureList& f) {
    f.number(a.reference_frequency, "reference_frequency", "Hz", 10e3, 10e6,
             "at which beam widths and directivity index are given");
    f.degrees(a.receive_beam_width, "receive_beam_width", 0.05, 20, "-3 dB full width across track, one way");
    f.degrees(a.transmit_beam_width, "transmit_beam_width", 0.05, 20,
              "-3 dB full width along track, one way, narrow projector");
    f.degrees(a.wide_transmit_beam_width, "wide_transmit_beam_width", 0.05, 25, "the same, wide projector");
    f.number(a.receiver.bandwidth, "receiver_bandwidth", "Hz", 100, 1e6, "for the noise; in H0");
    f.number(a.image_reference, "image_reference", "dB re 1 uPa", 0, 300,
             "level after gain that reads 255 at 0 dB brightness");
    f.number(a.magnitude_reference, "magnitude_reference", "dB re 1 uPa", 0, 300,
             "level after gain that reads 65535 in I1, WCD0, SNI0 and TPX0");
    multibeam::list_figures(a.detection, f);
    f.common(a.horizontal, a.vertical, a.receiver);
    f.stave_errors(a.errors, serial);
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f, const Variant& variant) {
    describe(s.start, o, variant);
    describe_wire(s, o);
    describe(s.acoustics, s.serial.view(), f);
}

Settings read_settings(const DeviceConfig& config, const Variant& variant) {
    auto s = fill_settings<Settings>(config, variant);
    fit(s.start, variant);
    s.variant = &variant;
    s.model = variant.number;
    s.tvg = config.effects.has(Effect::tvg);
    s.pulse = config.effects.has(Effect::pulse);
    s.sound_speed = config.sound_speed;
    s.unix_start = config.unix_start;
    return s;
}

}  // namespace echoloop::r2sonic_device
