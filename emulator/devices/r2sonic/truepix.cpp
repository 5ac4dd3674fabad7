#include <cmath>

#include "emulator/devices/r2sonic/levels.h"
#include "emulator/devices/r2sonic/packets.h"
#include "protocols/r2sonic/codec.h"

namespace echoloop::r2sonic_device {
namespace {

constexpr std::size_t samples_per_datagram =
    150;                                       // with directions and H0 1416 bytes, below an Ethernet frame
constexpr double widest = 1.5707963267948966;  // rad, of the largest angle on the wire

/// What is strongest on one side at each range.
struct Side {
    std::vector<float> power;
    std::vector<std::int16_t> angle;  ///< in steps
    std::vector<std::uint16_t> magnitude;
};

std::int16_t steps(double angle) { return static_cast<std::int16_t>(std::lround(angle / widest * 32767)); }

/// Beams [first, last), at those angles.
Side strongest(const Echogram& echogram, const std::vector<double>& angles, std::size_t first,
               std::size_t last, const std::vector<float>& gain) {
    const std::size_t bins = echogram.shot.bins;
    Side side{std::vector<float>(bins, 0.0F), std::vector<std::int16_t>(bins, 0),
              std::vector<std::uint16_t>(bins)};
    for (std::size_t beam = first; beam < last; ++beam) {
        const float* power = echogram.beam(beam).data();
        const std::int16_t angle = steps(angles[beam]);
        for (std::size_t i = 0; i < bins; ++i) {
            const bool more = power[i] > side.power[i];
            side.power[i] = more ? power[i] : side.power[i];
            side.angle[i] = more ? angle : side.angle[i];
        }
    }
    if (echogram.rule != EchoRule::cerqueira2016)
        for (std::size_t i = 0; i < bins; ++i) side.power[i] = std::sqrt(side.power[i] * gain[i]);
    quantise(side.power.data(), bins, side.magnitude.data());
    return side;
}

/// Samples [first, last) that TPG0 lets through: any that lie in some beam's gate, so that a side reaches as
/// far as the gate of its outermost beam.
std::pair<std::size_t, std::size_t> gated(const Shot& shot, std::uint32_t mode,
                                          const std::vector<multibeam::TimeGate>& gates) {
    multibeam::TimeGate all = gates.front();
    for (const auto& gate : gates) all = {std::min(all.min, gate.min), std::max(all.max, gate.max)};
    const auto bin_of = [&](double time) {
        const double bin = (time - shot.first_bin_time) / shot.bin_interval;
        return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(shot.bins)));
    };
    const std::size_t last = mode >= 1 ? bin_of(all.max) : shot.bins;
    return {mode == 2 ? std::min(bin_of(all.min), last) : 0, last};
}

template <class Section>
void fill(Section& form, const Side& port, const Side& starboard, std::size_t first, std::size_t count) {
    form.first_sample = static_cast<std::uint32_t>(first);
    form.data.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        auto& sample = form.data[i];
        sample.port = port.magnitude[first + i];
        sample.starboard = starboard.magnitude[first + i];
        if constexpr (requires { sample.port_angle; }) {
            sample.port_angle = port.angle[first + i];
            sample.starboard_angle = starboard.angle[first + i];
        }
    }
}

}  // namespace

std::vector<Bytes> truepix_datagrams(const PingRecord& ping, const Settings& settings,
                                     const Echogram& echogram,
                                     const std::vector<multibeam::TimeGate>& gates) {
    const Controls& c = ping.controls;
    if (c.truepix == 0) return {};
    const auto gain = gain_curve(c, settings, echogram, settings.acoustics.magnitude_reference);
    const auto& angles = ping.beams.angles;
    const auto middle =
        static_cast<std::size_t>(std::lower_bound(angles.begin(), angles.end(), 0.0) - angles.begin());
    const Side port = strongest(echogram, angles, 0, middle, gain);
    const Side starboard = strongest(echogram, angles, middle, echogram.beams(), gain);
    const auto [first, last] = gated(echogram.shot, c.truepix_gates, gates);
    r2sonic::Tpx0 packet;
    packet.h0 = {make_h0(ping, settings, echogram), more_of(ping.beams)};
    r2sonic::H0& h0 = packet.h0->settings;
    h0.reserved108 = settings.old_truepix_header ? static_cast<std::uint16_t>(h0.vtx_offset) : 0;
    h0.points = 0;
    if (c.truepix == 1)
        packet.samples = r2sonic::D0{};
    else
        packet.samples = r2sonic::D1{};
    std::vector<Bytes> datagrams;
    for (std::size_t at = first; at < last; at += samples_per_datagram) {
        std::visit(
            [&](auto& form) {
                form.ping_number = ping.number;
                form.total_samples = static_cast<std::uint32_t>(echogram.shot.bins);
                if constexpr (requires { form.angle_scale; })
                    form.angle_scale = static_cast<float>(widest / 32767);
                fill(form, port, starboard, at, std::min(samples_per_datagram, last - at));
            },
            packet.samples);
        datagrams.push_back(r2sonic::serialise(packet));
        packet.h0.reset();
    }
    return datagrams;
}

}  // namespace echoloop::r2sonic_device
