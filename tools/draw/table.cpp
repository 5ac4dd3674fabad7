#include <array>
#include <bit>

#include "tools/draw/draw.h"
#include "tools/draw/file.h"

namespace echoloop::draw {
namespace {

/// All pings share the ranges of the first.
void check(std::span<const Echogram> pings) {
    if (pings.empty()) throw std::invalid_argument("pings: there is none to write");
    const Echogram& first = pings.front();
    for (const Echogram& ping : pings) {
        if (ping.values.size() != ping.beams() * ping.shot.bins)
            throw std::invalid_argument("echogram: the number of values is not beams x bins");
        if (ping.shot.bins != first.shot.bins || ping.sound_speed != first.sound_speed ||
            ping.shot.first_bin_time != first.shot.first_bin_time ||
            ping.shot.bin_interval != first.shot.bin_interval)
            throw std::invalid_argument("pings: the ranges of the bins differ");
    }
}

void put(std::string& line, const char* format, double value) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), format, value);
    line += text.data();
}

std::string npy_header(std::size_t beams, std::size_t bins) {
    std::string text = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(beams) + ", " +
                       std::to_string(bins) + "), }";
    text.append((64 - (10 + text.size() + 1) % 64) % 64, ' ');  // the data begin on a multiple of 64
    text += '\n';
    std::string head = "\x93NUMPY\x01";
    head += '\0';
    head += static_cast<char>(text.size() & 0xFF);
    head += static_cast<char>(text.size() >> 8);
    return head + text;
}

}  // namespace

void write_csv(const std::filesystem::path& path, std::span<const Echogram> pings) {
    check(pings);
    OutputFile file(path);
    std::string line = "bearing_deg";
    for (std::size_t bin = 0; bin < pings.front().shot.bins; ++bin)
        put(line, ",%.6g", pings.front().bin_range(bin));
    for (const Echogram& ping : pings)
        for (std::size_t beam = 0; beam < ping.beams(); ++beam) {
            line += '\n';
            put(line, "%.6f", rad_to_deg(ping.shot.pan + ping.shot.bearings[beam]));
            for (const float value : ping.beam(beam)) put(line, ",%.9g", value);
            file.write(line.data(), line.size());
            line.clear();
        }
    file.write("\n", 1);
    file.close();
}

void write_npy(const std::filesystem::path& path, std::span<const Echogram> pings) {
    static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");
    check(pings);
    std::size_t beams = 0;
    for (const Echogram& ping : pings) beams += ping.beams();
    OutputFile file(path);
    const std::string header = npy_header(beams, pings.front().shot.bins);
    file.write(header.data(), header.size());
    for (const Echogram& ping : pings) file.write(ping.values.data(), ping.values.size() * sizeof(float));
    file.close();
}

}  // namespace echoloop::draw
