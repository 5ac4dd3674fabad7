#include "emulator/devices/r2sonic/levels.h"
#include "emulator/devices/r2sonic/packets.h"
#include "emulator/devices/r2sonic/plane.h"
#include "protocols/r2sonic/codec.h"

namespace echoloop::r2sonic_device {
namespace {

constexpr std::size_t cells_per_datagram = 1280;  // 256 beams x 5 bins: 1328 bytes, below an Ethernet frame

/// How the bins of an echogram become those of an image.
struct Compression {
    std::size_t echogram_bins = 1;  ///< in one image bin
    std::size_t bins = 0;           ///< of the image
};

Compression plan(std::size_t height, std::size_t have) {
    Compression c;
    c.echogram_bins = std::max<std::size_t>(1, (have + height - 1) / height);
    c.bins = have / c.echogram_bins;
    return c;
}

/// A beam's image bins at full scale 1: the root of the mean power, under the paper's rule the greatest
/// value.
void compress(const Compression& c, bool paper, const float* power, const float* gain, float* out) {
    const std::size_t n = c.echogram_bins;
    const auto each = [&](const auto& together) {
        for (std::size_t b = 0; b < c.bins; ++b) {
            float all = 0;
            for (std::size_t i = 0; i < n; ++i) all = together(all, power[b * n + i]);
            out[b] = all;
        }
    };
    if (paper) return each([](float top, float value) { return std::max(top, value); });
    each([](float sum, float value) { return sum + value; });
    for (std::size_t b = 0; b < c.bins; ++b) out[b] = std::sqrt(out[b] * gain[b]);
}

/// Of the middle of each image bin, for the sum of its parts.
std::vector<float> image_gain(const Compression& c, const std::vector<float>& gain) {
    std::vector<float> out(c.bins);
    for (std::size_t b = 0; b < c.bins; ++b)
        out[b] = gain[b * c.echogram_bins + c.echogram_bins / 2] / static_cast<float>(c.echogram_bins);
    return out;
}

Plane make_plane(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
                 const std::vector<std::size_t>& shown, const Compression& c) {
    const auto fine = gain_curve(ping.controls, settings, echogram, settings.acoustics.image_reference,
                                 ping.controls.image_brightness);
    const auto gain = image_gain(c, fine);
    Plane plane;
    plane.make(shown.size(), c.bins, 1);
    std::vector<float> row(c.bins);
    const bool paper = echogram.rule == EchoRule::cerqueira2016;
    for (std::size_t beam = 0; beam < plane.beams; ++beam) {
        if (c.echogram_bins == 1)
            amplitudes(echogram, shown[beam], gain, row.data());
        else
            compress(c, paper, echogram.beam(shown[beam]).data(), gain.data(), row.data());
        quantise(row.data(), c.bins, plane.row(beam));
    }
    return plane;
}

/// One datagram; its data is written straight to its place.
Bytes part(r2sonic::Aid0Data& form, const Plane& plane, std::size_t first, std::size_t bins,
           bool bins_first) {
    form.m0.first_bin = static_cast<std::uint32_t>(first);
    form.m0.bins = static_cast<std::uint16_t>(bins);
    Bytes bytes = r2sonic::serialise(form);
    const auto copy = bins_first ? copy_columns_first : copy_columns;
    copy(plane, first, bins, bytes.data() + r2sonic::part_data_offset);
    return bytes;
}

}  // namespace

std::vector<Bytes> image_datagrams(const PingRecord& ping, const Settings& settings,
                                   const Echogram& echogram) {
    if (ping.controls.image_height == 0) return {};
    const Compression c = plan(ping.controls.image_height, echogram.shot.bins);
    const auto shown = shown_beams(echogram.beams());
    const Plane plane = make_plane(ping, settings, echogram, shown, c);
    r2sonic::Aid0Head head;
    head.h0 = make_h0(ping, settings);
    head.a1 = make_a1(ping, shown);
    std::vector<Bytes> datagrams{r2sonic::serialise(head)};
    r2sonic::Aid0Data form;
    form.m0.ping_number = ping.number;
    form.m0.total_bins = static_cast<std::uint32_t>(c.bins);
    const std::size_t per_bin = samples_per_bin(samples(ping.controls, settings)) * c.echogram_bins;
    form.m0.total_samples = static_cast<std::uint32_t>(c.bins * per_bin);
    form.m0.total_beams = form.m0.beams = static_cast<std::uint16_t>(plane.beams);
    const std::size_t bins = std::max<std::size_t>(1, cells_per_datagram / plane.beams);
    for (std::size_t first = 0; first < c.bins; first += bins)
        datagrams.push_back(part(form, plane, first, std::min(bins, c.bins - first), settings.bins_first));
    return datagrams;
}

}  // namespace echoloop::r2sonic_device
