#include "emulator/devices/r2sonic/settings.h"

#include <algorithm>

#include "emulator/contract/option_rows.h"
#include "emulator/contract/options.h"

namespace echoloop::r2sonic_device {
namespace {

const char* const manual = "operation manual, control commands";
const char* const example = "operation manual, example start values";

wire::Text<12> serial_number(const std::string& text) {
    if (text.size() > 12)
        throw std::invalid_argument("serial number '" + text + "' is longer than 12 characters");
    return std::string_view(text);
}

Acoustics read_acoustics(const Profile& p) {
    Acoustics a;
    a.reference_frequency = figure(p, "reference_frequency");
    a.receive_beam_width = deg_to_rad(figure(p, "receive_beam_width"));
    a.transmit_beam_width = deg_to_rad(figure(p, "transmit_beam_width"));
    a.wide_transmit_beam_width = deg_to_rad(figure(p, "wide_transmit_beam_width"));
    a.horizontal = axis_pattern(p, "horizontal");
    a.vertical = axis_pattern(p, "vertical");
    a.receiver = receiver(p);
    a.receiver.bandwidth = figure(p, "receiver_bandwidth");
    a.image_reference = figure(p, "image_reference");
    a.magnitude_reference = figure(p, "magnitude_reference");
    a.detection_margin = figure(p, "detection_margin");
    return a;
}

/// What commands change, as it is at power-up.
std::vector<Option> start_rows(const Variant& variant) {
    return {
        choice_row("trigger", {"free", "external", "command"}, "TRG0 at power-up", example),
        number_row("range", "m", 20, 2, 1200, "RNG0 at power-up", example),
        number_row("frequency", "Hz", 400e3, 90e3, 700e3, "FRQ0 at power-up", example),
        number_row("power", "dB re 1 uPa at 1 m", 191, 0, 221, "TXP0 at power-up; 0 transmits nothing",
                   example),
        number_row("pulse", "s", 20e-6, 10e-6, variant.longest_pulse, "TXL0 at power-up", example),
        number_row("gain", "half dB", 13, 1, 45, "GAN0 at power-up; times 2 is dB", example),
        number_row("spreading", "dB per decade of range", 30, 0, 60, "SPR0 at power-up", example),
        number_row("absorption", "dB/km", 80, 0, 200, "ABS0 at power-up", example),
        number_row("ping_rate", "Hz", 0, 0, 60,
                   "upper limit of the ping rate at power-up; 0: none (PRU0 = 0)", example),
        number_row("sector_width", "deg", 120, 10, rad_to_deg(variant.widest_sector), "SEW0 at power-up",
                   example),
        number_row("sector_rotation", "deg", 0, -70, 70, "SER0 at power-up, positive to starboard", example),
        choice_row("bottom_mode", {"equi-angle", "equi-distant"}, "BOS0 at power-up", example),
        flag_row("intensity", false, "BIE0 at power-up: BTH0 carries intensities", example),
        integer_row("image_height", "bins", 0, 0, 4096,
                    "AIH0 at power-up: upper limit of range bins in AID0; 0: no image", example),
        number_row("image_brightness", "dB", 6, 0, 60, "AIB0 at power-up", example),
        choice_row("projector", {"narrow", "wide"},
                   "PROJ at power-up: narrow 1 deg, wide 20 deg (forward looking)", example),
        choice_row("water_column", {"off", "magnitude", "phase"}, "WCM0 at power-up", example),
        flag_row("snippets", false, "SNIP at power-up", example),
        choice_row("truepix", {"off", "magnitude", "direction"}, "TPM0 at power-up", example),
    };
}

/// What no command changes.
std::vector<Option> wire_rows() {
    return {
        text_row("serial", "100017", "serial number of the head, at most 12 characters", "manual's example"),
        text_row("sim_serial", "100117", "serial number of the SIM, at most 12 characters",
                 "manual's example"),
        number_row("datagram_gap", "s", 0.3e-3, 0, 0.1, "time for each datagram of one image",
                   "receivers with default buffers lose faster ones; those of a millisecond leave together"),
        choice_row("discovery_reply", {"sender", "gui", "none"}, "where R2DI goes", manual),
        choice_row(
            "quality_bits", {"tests", "set", "clear"},
            "bits 1 and 0 of Q0 of good points: as the tests of colinearity and brightness say, always set, "
            "or clear",
            "manual v3.0; set in all real pings; reserved in v5.0 and v6.3"),
        flag_row("verbose_gates", false, "BTH0 carries the gate of every beam (G1)", manual),
        choice_row("image_order", {"beams", "bins"},
                   "what comes first in the data of AID0: all bins of a beam, or all beams of a bin",
                   "known readers; earlier versions of them read bins first"),
        choice_row("truepix_header", {"v6.3", "v5.0"},
                   "bytes 108 to 115 of TPX0's H0: reserved, or with the transmit voltage offset",
                   "manuals of these versions"),
        choice_row(
            "data_hosts", {"gui", "configured"},
            "where water column, snippets and TruePix go: to the host, or to R2DC's data acquisition hosts, "
            "the first for TruePix and snippets, the second for the water column",
            "normally the host itself; the order of the others is an own choice"),
        integer_row("multimode_sets", "", 0, 0, 4,
                    "pings take that many sets of MultiMode in turn (ABS1, FRQ1, ...); 0: none",
                    "manual; the command that starts it is not public"),
        number_row("sync_in", "Hz", 0, 0, 60, "pulses at the SIM's sync input, for TRG0 = 1; 0: none",
                   "own choice"),
    };
}

/// The place of an option's word among `words`.
std::uint32_t place(const Options& o, const char* name, std::initializer_list<std::string_view> words) {
    const auto* found = std::find(words.begin(), words.end(), std::string_view(text(o, name)));
    return static_cast<std::uint32_t>(found - words.begin());
}

Controls read_start(const Options& o, const Variant& variant) {
    Controls c;
    c.trigger = place(o, "trigger", {"free", "external", "command"});
    c.range = number(o, "range");
    c.frequency = number(o, "frequency");
    c.power = number(o, "power");
    c.pulse = number(o, "pulse");
    c.gain = number(o, "gain");
    c.spreading = number(o, "spreading");
    c.absorption = number(o, "absorption");
    c.limit_ping_rate = number(o, "ping_rate") > 0;
    if (c.limit_ping_rate) c.ping_rate = number(o, "ping_rate");
    c.sector_width = deg_to_rad(number(o, "sector_width"));
    c.sector_rotation = deg_to_rad(number(o, "sector_rotation"));
    c.equi_distant = text(o, "bottom_mode") == "equi-distant";
    c.intensity = flag(o, "intensity");
    c.image_height = static_cast<std::uint32_t>(integer(o, "image_height"));
    c.image_brightness = number(o, "image_brightness");
    c.projector = 1 + place(o, "projector", {"narrow", "wide"});
    c.water_column = place(o, "water_column", {"off", "magnitude", "phase"});
    c.snippets = flag(o, "snippets");
    c.truepix = place(o, "truepix", {"off", "magnitude", "direction"});
    fit(c, variant);
    return c;
}

void read_wire(const Options& o, Settings& s) {
    s.datagram_gap = number(o, "datagram_gap");
    s.answer_discovery = text(o, "discovery_reply") != "none";
    s.discovery_to_sender = text(o, "discovery_reply") == "sender";
    s.test_bits = static_cast<TestBits>(place(o, "quality_bits", {"tests", "set", "clear"}));
    s.verbose_gates = flag(o, "verbose_gates");
    s.bins_first = text(o, "image_order") == "bins";
    s.old_truepix_header = text(o, "truepix_header") == "v5.0";
    s.configured_hosts = text(o, "data_hosts") == "configured";
    s.mode_sets = static_cast<std::size_t>(integer(o, "multimode_sets"));
    s.sync_in = number(o, "sync_in");
}

}  // namespace

std::vector<FigureRow> figure_table() {
    std::vector<FigureRow> rows{
        {"reference_frequency", "Hz", "at which beam widths and directivity index are given", 10e3, 10e6},
        {"receive_beam_width", "deg", "-3 dB full width across track, one way", 0.05, 20},
        {"transmit_beam_width", "deg", "-3 dB full width along track, one way, narrow projector", 0.05, 20},
        {"wide_transmit_beam_width", "deg", "the same, wide projector", 0.05, 25},
        {"receiver_bandwidth", "Hz", "for the noise; in H0", 100, 1e6},
        {"image_reference", "dB re 1 uPa", "level after gain that reads 255 at 0 dB brightness", 0, 300},
        {"magnitude_reference", "dB re 1 uPa", "level after gain that reads 65535 in WCD0, SNI0 and TPX0", 0,
         300},
        {"detection_margin", "dB", "echoes that are not so far above the noise are no bottom", 0, 60},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table(const Variant& variant) {
    std::vector<Option> rows = start_rows(variant);
    auto others = wire_rows();
    std::move(others.begin(), others.end(), std::back_inserter(rows));
    return rows;
}

Settings read_settings(const DeviceConfig& config, const Variant& variant) {
    const Options& o = config.options;
    Settings s;
    s.variant = &variant;
    s.model = variant.number;
    s.serial = serial_number(text(o, "serial"));
    s.sim_serial = serial_number(text(o, "sim_serial"));
    s.start = read_start(o, variant);
    s.acoustics = read_acoustics(config.profile);
    s.tvg = config.effects.has(Effect::tvg);
    s.pulse = config.effects.has(Effect::pulse);
    s.sound_speed = config.sound_speed;
    s.unix_start = config.unix_start;
    read_wire(o, s);
    return s;
}

}  // namespace echoloop::r2sonic_device
