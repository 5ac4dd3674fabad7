#include "emulator/devices/family/imagenex/settings.h"

#include <stdexcept>

#include "emulator/contract/endpoint.h"

namespace echoloop::imagenex_head {
namespace {

const char* const spec = "Imagenex specification notes";

/// Of the one line; 0: of datagrams, which come as a whole when their last byte would.
double reply_rate(const DeviceConfig& config, double baud) {
    if (config.endpoints.size() != 1)
        throw std::invalid_argument("an Imagenex head has one serial line: give exactly one endpoint");
    if (config.endpoints.front().on_udp()) return 0;
    return line_rate(config.endpoints, baud);
}

void describe_line(Settings& s, OptionList& o, const Choices& choices) {
    o.whole(s.head_id, "head_id", "", choices.lowest_id, choices.highest_id,
            "answers only commands for this id; several heads may share a pair", spec);
    o.choice(s.strict, "mode_byte", {"any", "strict"},
             "strict: answers only if byte 6 has the bits transmit, send data and slave", spec);
    o.words(s.status, "status", choices.status, "byte 4 of a reply, hexadecimal", spec);
    o.choice(s.obey_baud, "reply_baud", {"ignored", "honoured"},
             "whether byte 21 of a command sets the rate of its reply", spec);
    o.number(s.line_rate, "baud", "bit/s", 0, 4e6,
             "line rate of pty and TCP endpoints; 0: the reply comes as a whole at the time of its last byte",
             spec);
}

void describe_timing(Settings& s, OptionList& o) {
    o.choice(s.timing, "timing", {"table", "none", "fixed"},
             "time from the command to the end of the reply: the maker's table, only the echo and the line, "
             "or fixed_time",
             spec);
    o.number(s.fixed_time, "fixed_time", "s", 0.001, 60,
             "time with timing: fixed; never shorter than the echo takes", spec);
}

void describe_data(Settings& s, OptionList& o, const Choices& choices) {
    o.words(s.ceiling, "echo_ceiling", choices.ceilings, "greatest value of 8-bit echo data", spec);
    o.choice(s.seven_bits_each, "data_16_bit", {"plain", "7+7"},
             "16-bit echo data, low byte first: 0 to 65535, or 14 bits with bit 7 of each byte clear", spec);
    o.choice(s.keep_fc, "fc_in_data", {"avoided", "kept"},
             "an FC within 4-bit, 16-bit or over-127 echo data: sent as FB, because some hosts read up to "
             "the first FC, or unchanged",
             "own choice: how a head avoids it is not known");
    double threshold = 50;
    o.number(threshold, "profile_threshold", "%", 1, 100,
             "of the scale; the first echo above it is the profile range",
             "recordings of a real 852: first values of 64 to 127 of 127");
    s.profile_threshold = threshold / 100;
}

void describe(Acoustics& a, FigureList& f) {
    f.number(a.frequency, "frequency", "Hz", 10e3, 10e6, "at which the widths are given");
    f.number(a.source_level, "source_level", "dB re 1 uPa at 1 m", 100, 240, "on the axis");
    f.degrees(a.beam_width, "beam_width", 0.1, 90, "horizontal -3 dB full width, two-way");
    f.degrees(a.fan_height, "fan_height", 0.1, 120, "vertical -3 dB full width, two-way");
    f.number(a.receiver.bandwidth, "receiver_bandwidth", "Hz", 1e2, 1e7, "for the noise, whatever the pulse");
    f.number(a.full_scale_level, "full_scale_level", "dB re 1 uPa", 0, 300,
             "reads full scale where all gains are 0 dB");
    f.number(a.nearest_range, "nearest_range", "m", 0, 10, "echoes from nearer are no profile range");
    f.common(a.horizontal, a.vertical, a.receiver);
}

}  // namespace

void describe(Settings& s, OptionList& o, FigureList& f, const Choices& choices) {
    describe_line(s, o, choices);
    describe_timing(s, o);
    describe_data(s, o, choices);
    describe(s.acoustics, f);
}

void complete(Settings& s, const DeviceConfig& config) {
    s.line_rate = reply_rate(config, s.line_rate);
    s.acoustics.tvg = config.effects.has(Effect::tvg);
}

}  // namespace echoloop::imagenex_head
