#include <cmath>

#include "emulator/devices/r2sonic/levels.h"
#include "emulator/devices/r2sonic/packets.h"
#include "protocols/r2sonic/codec.h"

namespace echoloop::r2sonic_device {
namespace {

constexpr std::size_t section_header = 32, packet_header = 12, h0_size = 140;
constexpr std::size_t most_samples = 32000;  // one snippet in the largest datagram of UDP

/// The echo of a point and as much again on either side, in samples of the echogram: [first, last).
std::pair<std::size_t, std::size_t> window(const Shot& shot, const multibeam::Detection& d) {
    const double margin = (d.end - d.begin) / 2;
    const auto bin_of = [&](double time) {
        const double bin = (time - shot.first_bin_time) / shot.bin_interval;
        return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(shot.bins)));
    };
    const std::size_t first = bin_of(d.begin - margin);
    return {first, std::min({bin_of(d.end + margin) + 1, shot.bins, first + most_samples})};
}

r2sonic::S1 make_snippet(const PingRecord& ping, const Echogram& echogram, std::size_t point,
                         const multibeam::Detection& detection, const std::vector<float>& gain) {
    const auto [first, last] = window(echogram.shot, detection);
    const auto power = echogram.beam(point);
    r2sonic::S1 snippet;
    snippet.ping_number = ping.number;
    snippet.snippet = static_cast<std::uint16_t>(point);
    snippet.first_sample = static_cast<std::uint32_t>(first);
    snippet.angle = static_cast<float>(ping.beams.angles[point]);
    std::vector<float> row;
    const bool paper = echogram.rule == EchoRule::cerqueira2016;
    for (std::size_t i = first; i < last; ++i)
        row.push_back(paper ? power[i] : std::sqrt(power[i] * gain[i]));
    snippet.magnitude.resize(row.size());
    quantise(row.data(), row.size(), snippet.magnitude.data());
    return snippet;
}

std::size_t size_of(const r2sonic::S1& snippet) {
    return section_header + (snippet.magnitude.size() + 1) / 2 * 4;
}

}  // namespace

std::vector<Bytes> snippet_datagrams(const PingRecord& ping, const Settings& settings,
                                     const Echogram& echogram,
                                     const std::vector<multibeam::Detection>& detections) {
    if (!ping.controls.snippets) return {};
    const auto gain = gain_curve(ping.controls, settings, echogram, settings.acoustics.magnitude_reference);
    std::vector<Bytes> datagrams;
    r2sonic::Sni0 packet;
    packet.h0 = {make_h0(ping, settings, echogram), more_of(ping.beams)};
    packet.h0->settings.points = static_cast<std::uint16_t>(detections.size());
    std::size_t filled = 0;  // bytes of the packet so far; 0: it has no snippet yet
    for (std::size_t point = 0; point < detections.size(); ++point) {
        if (!detections[point].found()) continue;
        auto snippet = make_snippet(ping, echogram, point, detections[point], gain);
        if (filled > 0 && filled + size_of(snippet) > frame_payload) {
            datagrams.push_back(r2sonic::serialise(packet));
            packet = {};
            filled = 0;
        }
        const std::size_t size = size_of(snippet);
        if (filled == 0) {
            filled = packet_header + (packet.h0 ? h0_size : 0) + size;
            packet.s1 = std::move(snippet);
        } else {
            filled += size;
            packet.others.push_back(std::move(snippet));
        }
    }
    if (filled > 0) datagrams.push_back(r2sonic::serialise(packet));
    return datagrams;
}

}  // namespace echoloop::r2sonic_device
