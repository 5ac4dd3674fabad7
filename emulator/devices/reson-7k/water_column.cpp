// Record 7042: the samples of record 7018, beam by beam, cut, thinned out and shortened as command 7042 says.
#include <algorithm>
#include <cmath>

#include "emulator/devices/reson-7k/records.h"

namespace echoloop::reson7k_device {
namespace {

namespace bits = reson7k::water_column;

enum class Thinning : std::uint32_t { none, middle, peak, mean };

/// As in 7018: amplitude in the low half, phase in the high one.
std::uint16_t amplitude_of(std::uint32_t sample) { return static_cast<std::uint16_t>(sample); }
std::int16_t phase_of(std::uint32_t sample) { return static_cast<std::int16_t>(sample >> 16); }

std::uint32_t mean_of(std::span<const std::uint32_t> samples) {
    const auto count = static_cast<std::int64_t>(samples.size());
    std::int64_t amplitude = 0, phase = 0;
    for (const std::uint32_t sample : samples) amplitude += amplitude_of(sample), phase += phase_of(sample);
    return static_cast<std::uint32_t>(amplitude / count) |
           static_cast<std::uint32_t>(static_cast<std::uint16_t>(phase / count)) << 16;
}

std::uint32_t one_of(std::span<const std::uint32_t> samples, Thinning thinning) {
    const auto quieter = [](std::uint32_t a, std::uint32_t b) { return amplitude_of(a) < amplitude_of(b); };
    if (thinning == Thinning::peak) return *std::max_element(samples.begin(), samples.end(), quieter);
    return thinning == Thinning::mean ? mean_of(samples) : samples[samples.size() / 2];
}

/// One of every whole `divisor` samples.
std::vector<std::uint32_t> thinned(const std::vector<std::uint32_t>& samples, std::uint32_t flags) {
    const auto thinning = static_cast<Thinning>(flags >> bits::thinning_shift & 15);
    const std::size_t divisor = flags >> bits::divisor_shift & 15;
    if (thinning == Thinning::none) return samples;
    std::vector<std::uint32_t> left;
    for (std::size_t at = 0; at + divisor <= samples.size(); at += divisor)
        left.push_back(one_of(std::span(samples).subspan(at, divisor), thinning));
    return left;
}

/// 8 bits of amplitude: 40 log10, as without a factor in the record.
std::uint8_t decibels_of(std::uint16_t amplitude) {
    return amplitude == 0 ? 0 : static_cast<std::uint8_t>(40 * std::log10(amplitude) + 0.5);
}

void put(Bytes& bytes, std::uint32_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

void put_samples(Bytes& bytes, const std::vector<std::uint32_t>& samples, std::uint32_t flags) {
    const bool phase = (flags & bits::no_phase) == 0, in_bytes = (flags & bits::in_bytes) != 0;
    for (const std::uint32_t sample : samples) {
        const std::uint16_t amplitude = amplitude_of(sample);
        put(bytes, in_bytes ? decibels_of(amplitude) : amplitude, in_bytes ? 1 : 2);
        if (phase) put(bytes, in_bytes ? sample >> 24 : sample >> 16, in_bytes ? 1 : 2);
    }
}

/// How many samples of each beam go in: those to a tenth beyond its bottom, or all.
std::vector<std::size_t> lengths(const PingRecord& ping, const Settings& settings, const Echogram& echogram) {
    std::vector<std::size_t> all(echogram.beams(), echogram.shot.bins);
    if ((ping.controls.water_column & bits::to_bottom) == 0) return all;
    for (const reson7k::Detection& point : make_detections(ping, settings, echogram).detections)
        all[point.beam] = std::min(all[point.beam], static_cast<std::size_t>(std::ceil(1.1F * point.sample)));
    return all;
}

}  // namespace

reson7k::WaterColumn make_water_column(const PingRecord& ping, const Settings& settings,
                                       const Echogram& echogram) {
    const std::uint32_t flags = ping.controls.water_column;
    const reson7k::Beamformed whole = make_beamformed(ping, settings, echogram);
    const auto wanted = lengths(ping, settings, echogram);
    const bool thins = flags >> bits::thinning_shift != 0;
    const double divisor = thins ? flags >> bits::divisor_shift & 15 : 1;
    reson7k::WaterColumn record;
    record.serial = whole.serial;
    record.ping = whole.ping;
    record.beams = whole.beams;
    record.samples = whole.samples;
    record.flags = flags;
    record.sample_rate = static_cast<float>(sample_rate(ping.controls, settings) / divisor);
    for (std::size_t beam = 0; beam < whole.beams; ++beam) {
        std::vector<std::uint32_t> samples(wanted[beam]);
        for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = whole.data[i * whole.beams + beam];
        samples = thinned(samples, flags);
        const auto count = static_cast<std::uint32_t>(samples.size());
        record.compressed_samples = std::max(record.compressed_samples, count);
        put(record.data, static_cast<std::uint32_t>(beam), 2);
        put(record.data, count, 4);
        put_samples(record.data, samples, flags);
    }
    return record;
}

}  // namespace echoloop::reson7k_device
