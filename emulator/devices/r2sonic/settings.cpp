#include "emulator/devices/r2sonic/settings.h"

#include "emulator/option_rows.h"
#include "emulator/options.h"

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
    a.detection_margin = figure(p, "detection_margin");
    return a;
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
        {"detection_margin", "dB", "echoes that are not so far above the noise are no bottom", 0, 60},
    };
    auto common = common_figures();
    std::move(common.begin(), common.end(), std::back_inserter(rows));
    return rows;
}

std::vector<Option> option_table() {
    return {
        choice_row("trigger", {"free", "external", "command"}, "TRG0 at power-up", example),
        number_row("range", "m", 20, 2, 1200, "RNG0 at power-up", example),
        number_row("frequency", "Hz", 400e3, 90e3, 700e3, "FRQ0 at power-up", example),
        number_row("power", "dB re 1 uPa at 1 m", 191, 0, 221, "TXP0 at power-up; 0 transmits nothing",
                   example),
        number_row("pulse", "s", 20e-6, 10e-6, 1115e-6, "TXL0 at power-up", example),
        number_row("gain", "half dB", 13, 1, 45, "GAN0 at power-up; times 2 is dB", example),
        number_row("spreading", "dB per decade of range", 30, 0, 60, "SPR0 at power-up", example),
        number_row("absorption", "dB/km", 80, 0, 200, "ABS0 at power-up", example),
        number_row("ping_rate", "Hz", 0, 0, 60,
                   "upper limit of the ping rate at power-up; 0: none (PRU0 = 0)", example),
        number_row("sector_width", "deg", 120, 10, 160, "SEW0 at power-up", example),
        number_row("sector_rotation", "deg", 0, -70, 70, "SER0 at power-up, positive to starboard", example),
        choice_row("bottom_mode", {"equi-angle", "equi-distant"}, "BOS0 at power-up", example),
        flag_row("intensity", false, "BIE0 at power-up: BTH0 carries intensities", example),
        integer_row("image_height", "bins", 0, 0, 4096,
                    "AIH0 at power-up: upper limit of range bins in AID0; 0: no image", example),
        number_row("image_brightness", "dB", 6, 0, 60, "AIB0 at power-up", example),
        choice_row("projector", {"narrow", "wide"},
                   "PROJ at power-up: narrow 1 deg, wide 20 deg (forward looking)", example),
        text_row("serial", "100017", "serial number of the head, at most 12 characters", "manual's example"),
        text_row("sim_serial", "100117", "serial number of the SIM, at most 12 characters",
                 "manual's example"),
        number_row("datagram_gap", "s", 0.3e-3, 0, 0.1, "pause between the datagrams of one image",
                   "receivers with default buffers lose faster bursts"),
        choice_row("discovery_reply", {"sender", "gui", "none"}, "where R2DI goes", manual),
    };
}

Settings read_settings(const DeviceConfig& config) {
    const Options& o = config.options;
    Settings s;
    s.serial = serial_number(text(o, "serial"));
    s.sim_serial = serial_number(text(o, "sim_serial"));
    Controls& c = s.start;
    c.trigger = text(o, "trigger") == "free" ? 0 : text(o, "trigger") == "external" ? 1 : 2;
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
    c.projector = text(o, "projector") == "wide" ? 2 : 1;
    s.acoustics = read_acoustics(config.profile);
    s.tvg = config.effects.has(Effect::tvg);
    s.pulse = config.effects.has(Effect::pulse);
    s.datagram_gap = number(o, "datagram_gap");
    s.answer_discovery = text(o, "discovery_reply") != "none";
    s.discovery_to_sender = text(o, "discovery_reply") == "sender";
    s.sound_speed = config.sound_speed;
    s.unix_start = config.unix_start;
    return s;
}

}  // namespace echoloop::r2sonic_device
