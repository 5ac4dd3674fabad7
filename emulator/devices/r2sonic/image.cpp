#include <algorithm>
#include <cmath>

#include "emulator/devices/r2sonic/packets.h"

namespace echoloop::r2sonic_device {
namespace {

constexpr std::size_t bins_per_datagram = 5;  // 256 beams x 5 bins: 1328 bytes, below an Ethernet frame

/// How the samples of a ping become the bins of its image.
struct Compression {
    std::size_t echogram_bins = 1;  ///< echogram bins in one image bin
    std::size_t bins = 0;           ///< of the image
    std::size_t samples = 0;        ///< before compression
};

Compression plan(const PingRecord& ping, const Settings& settings, const Echogram& echogram) {
    const std::size_t height = ping.controls.image_height, have = echogram.shot.bins;
    const std::size_t per_bin = samples_per_bin(samples(ping.controls, settings));
    Compression c;
    c.echogram_bins = std::max<std::size_t>(1, (have + height - 1) / height);
    c.bins = have / c.echogram_bins;
    c.samples = c.bins * c.echogram_bins * per_bin;
    return c;
}

/// Gain, TVG and brightness as one factor on the power of a bin at `range` m.
float image_gain(const PingRecord& ping, const Settings& settings, double range) {
    const Controls& c = ping.controls;
    const double r = std::max(range, 1.0);
    const double tvg = settings.tvg ? c.spreading * std::log10(r) + 2 * c.absorption / 1000 * r : 0;
    const double db = 2 * c.gain + tvg + c.image_brightness - settings.acoustics.image_reference;
    return static_cast<float>(std::pow(10.0, db / 10));
}

/// Amplitude 0..1 to a byte.
std::uint8_t to_byte(float amplitude) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(amplitude, 0.0F, 1.0F)));
}

/// The whole image, beam-major.
std::vector<std::uint8_t> compress(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
                                   const Compression& c) {
    const bool paper = echogram.rule == EchoRule::cerqueira2016;
    std::vector<float> gain(c.bins);
    for (std::size_t b = 0; b < c.bins; ++b)
        gain[b] = image_gain(ping, settings, echogram.bin_range(b * c.echogram_bins + c.echogram_bins / 2)) /
                  static_cast<float>(c.echogram_bins);
    std::vector<std::uint8_t> image(beams * c.bins);
    for (std::size_t beam = 0; beam < beams; ++beam) {
        const auto levels = echogram.beam(beam);
        for (std::size_t b = 0; b < c.bins; ++b) {
            const auto part = levels.subspan(b * c.echogram_bins, c.echogram_bins);
            float sum = 0, top = 0;
            for (float level : part) sum += level, top = std::max(top, level);
            image[beam * c.bins + b] = to_byte(paper ? top : std::sqrt(sum * gain[b]));
        }
    }
    return image;
}

r2sonic::M0 section(const PingRecord& ping, const Compression& c, const std::vector<std::uint8_t>& image,
                    std::size_t first) {
    r2sonic::M0 m;
    m.ping_number = ping.number;
    m.total_samples = static_cast<std::uint32_t>(c.samples);
    m.total_bins = static_cast<std::uint32_t>(c.bins);
    m.first_bin = static_cast<std::uint32_t>(first);
    m.bins = static_cast<std::uint16_t>(std::min(bins_per_datagram, c.bins - first));
    m.total_beams = m.beams = beams;
    m.data.resize(beams * m.bins);
    for (std::size_t beam = 0; beam < beams; ++beam)
        std::copy_n(image.begin() + static_cast<std::ptrdiff_t>(beam * c.bins + first), m.bins,
                    m.data.begin() + static_cast<std::ptrdiff_t>(beam * m.bins));
    return m;
}

}  // namespace

std::vector<r2sonic::Packet> make_image(const PingRecord& ping, const Settings& settings,
                                        const Echogram& echogram) {
    if (ping.controls.image_height == 0 || echogram.beams() != beams) return {};
    const Compression c = plan(ping, settings, echogram);
    const auto image = compress(ping, settings, echogram, c);
    r2sonic::Aid0Head head;
    head.h0 = make_h0(ping, settings);
    head.a1.more = {0, static_cast<float>(ping.controls.projector_z), 0, 0, 0, 0};
    head.a1.angle.assign(ping.beams.angles.begin(), ping.beams.angles.end());
    std::vector<r2sonic::Packet> packets{std::move(head)};
    for (std::size_t first = 0; first < c.bins; first += bins_per_datagram)
        packets.push_back(r2sonic::Aid0Data{0, section(ping, c, image, first)});
    return packets;
}

}  // namespace echoloop::r2sonic_device
