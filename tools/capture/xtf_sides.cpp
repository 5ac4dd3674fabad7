#include "tools/capture/xtf_sides.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "protocols/edgetech/codec.h"
#include "tools/capture/little_endian.h"

namespace echoloop::capture {
namespace {

using edgetech::SonarData;

constexpr std::size_t xtf_file_header = 1024, info_at = 256, info_size = 128, channel_header = 64,
                      most_side_samples = 130000;
constexpr std::uint8_t port = 1, starboard = 2;
constexpr double assumed_sound_speed = 1500;

float f32(ByteView bytes, std::size_t at) { return std::bit_cast<float>(little::u32(bytes, at)); }
double finite_or(double value, double other) { return std::isfinite(value) ? value : other; }

std::int32_t whole_number(double value) {
    return static_cast<std::int32_t>(std::clamp(finite_or(std::round(value), 0), -2e9, 2e9));
}

/// What the ping's header says of the place; zeros say nothing.
void read_place(ByteView packet, SonarData& data) {
    namespace valid = edgetech::valid;
    constexpr double turn = 32768.0 / 180, arc = 60e4;
    const double y = little::f64(packet, 160), x = little::f64(packet, 168);
    if (std::abs(y) <= 90 && std::abs(x) <= 180 && (x != 0 || y != 0)) {
        data.position_units = 2;
        data.x = whole_number(arc * x);
        data.y = whole_number(arc * y);
        data.validity |= valid::position;
    }
    const double heading = finite_or(f32(packet, 212), 0);
    data.heading = static_cast<std::uint16_t>(std::lround(100 * std::remainder(heading - 180, 360)) + 18000);
    data.pitch = static_cast<std::int16_t>(std::clamp(whole_number(turn * f32(packet, 204)), -32768, 32767));
    data.roll = static_cast<std::int16_t>(std::clamp(whole_number(turn * f32(packet, 208)), -32768, 32767));
    data.depth = whole_number(1e3 * f32(packet, 192));
    data.altitude = whole_number(1e3 * f32(packet, 196));
    data.validity |= valid::heading | valid::pitch_roll;
    if (data.depth != 0) data.validity |= valid::depth;
    if (data.altitude != 0) data.validity |= valid::altitude;
}

void put_samples(SonarData& data, const std::vector<double>& samples, bool near_first) {
    constexpr double full_scale = 65535;
    const double peak = samples.empty() ? 0 : std::ranges::max(samples);
    int bits = 0;
    while (std::ldexp(peak, bits) > full_scale && bits > -64) --bits;
    data.weighting = static_cast<std::int16_t>(bits);
    edgetech::set_sample_count(data, samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double one = std::ldexp(samples[near_first ? i : samples.size() - 1 - i], bits);
        const auto word = static_cast<std::uint16_t>(std::lround(std::min(one, full_scale)));
        data.data.push_back(static_cast<std::uint8_t>(word));
        data.data.push_back(static_cast<std::uint8_t>(word >> 8));
    }
}

}  // namespace

XtfSides::XtfSides(ByteView header) {
    if (header.size() < xtf_file_header) return;
    count_ = std::min<std::size_t>(little::u16(header, 166), channels_.size());
    any_ = count_ > 0 && little::u16(header, 168) == 0;
    constexpr std::uint8_t ieee = 5;
    for (std::size_t i = 0; i < count_; ++i) {
        const ByteView info = header.subspan(info_at + i * info_size, info_size);
        channels_[i] = {.type = info[0],
                        .sample_bytes = little::u16(info, 6),
                        .floating = info[74] == ieee,
                        .signs = little::u16(info, 4) == 0,
                        .frequency = 1e3 * finite_or(f32(info, 32), 0)};
    }
}

std::vector<Bytes> XtfSides::messages(ByteView packet, double time) const {
    std::vector<Bytes> out;
    if (packet.size() < xtf_ping_header) return out;
    const double half = f32(packet, 32), computed = f32(packet, 72);
    const auto is_speed = [](double c) { return c > 1300 && c < 1700; };
    const double speed = is_speed(computed)   ? computed
                         : is_speed(half)     ? half
                         : is_speed(2 * half) ? 2 * half
                                              : assumed_sound_speed;
    const std::size_t channels = little::u16(packet, 4);
    std::size_t at = xtf_ping_header;
    for (std::size_t i = 0; i < channels && at + channel_header <= packet.size(); ++i) {
        const ByteView head = packet.subspan(at, channel_header);
        const std::size_t number = little::u16(head, 0), samples = little::u32(head, 42);
        at += channel_header;
        if (number >= count_) break;  // how long its samples are is not known
        const Channel& channel = channels_[number];
        const std::size_t size = channel.sample_bytes;
        if ((size != 1 && size != 2 && size != 4) || samples > (packet.size() - at) / size) break;
        const ByteView bytes = packet.subspan(at, samples * size);
        at += samples * size;
        if ((channel.type != port && channel.type != starboard) || samples == 0 ||
            samples > most_side_samples)
            continue;

        std::vector<double> levels(samples);
        for (std::size_t k = 0; k < samples; ++k) {
            double one = 0;
            if (size == 1) one = bytes[k];
            if (size == 2)
                one = channel.signs ? std::abs(double(static_cast<std::int16_t>(little::u16(bytes, 2 * k))))
                                    : double(little::u16(bytes, 2 * k));
            if (size == 4)
                one = channel.floating ? std::abs(finite_or(f32(bytes, 4 * k), 0))
                                       : double(little::u32(bytes, 4 * k));
            levels[k] = one;
        }
        SonarData data;
        data.seconds = static_cast<std::int32_t>(std::clamp(time, 0.0, 2e9));
        data.milliseconds =
            static_cast<std::uint32_t>(std::llround(1e3 * std::fmod(std::max(time, 0.0), 86400)));
        data.ping = little::u32(packet, 28);
        data.sound_speed = static_cast<float>(speed);
        data.validity = edgetech::valid::sound_speed;
        const double range = f32(head, 4), interval = 2e9 * range / speed / double(samples);
        data.interval = static_cast<std::uint32_t>(std::clamp(finite_or(std::round(interval), 0), 0.0, 4e9));
        const double kilohertz = little::u16(head, 26);
        const double frequency = std::clamp(kilohertz > 0 ? 1e3 * kilohertz : channel.frequency, 0.0, 10e6);
        edgetech::set_frequencies(data, frequency, frequency);
        read_place(packet, data);
        put_samples(data, levels, channel.type == starboard);
        const auto weight = static_cast<std::int16_t>(little::u16(head, 58));
        data.weighting = static_cast<std::int16_t>(std::clamp(data.weighting + weight, -64, 64));

        // One pair: by its frequency; two: in their order.
        constexpr double high = 200e3;
        const bool second = count_ > 2 ? number >= 2 : frequency >= high;
        edgetech::Header header;
        header.subsystem = second ? edgetech::high_frequency : edgetech::low_frequency;
        header.channel = channel.type == port ? 0 : 1;
        out.push_back(edgetech::encode({header, std::move(data)}));
    }
    return out;
}

}  // namespace echoloop::capture
