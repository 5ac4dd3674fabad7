#include <cmath>

#include "emulator/devices/r2sonic/levels.h"
#include "emulator/devices/r2sonic/packets.h"
#include "emulator/devices/r2sonic/plane.h"
#include "protocols/r2sonic/codec.h"
#include "protocols/wire/bytes.h"

namespace echoloop::r2sonic_device {
namespace {

constexpr std::size_t cells_per_datagram = 256 * 36;  // the manual's typical section

/// Where in the shown beam at `place` an echo lies, -1 at the one to port to 1 at the one to starboard: from
/// the balance of power between them, since an echogram has no phases.
void phases(const Echogram& echogram, const std::vector<std::size_t>& shown, std::size_t place,
            std::int16_t* out) {
    const std::size_t last = shown.size() - 1, bins = echogram.shot.bins;
    const float* port = echogram.beam(shown[place == 0 ? 0 : place - 1]).data();
    const float* own = echogram.beam(shown[place]).data();
    const float* starboard = echogram.beam(shown[std::min(place + 1, last)]).data();
    for (std::size_t i = 0; i < bins; ++i) {
        const float sum = port[i] + own[i] + starboard[i] + 1e-20F;
        out[i] = static_cast<std::int16_t>(32767.0F * ((starboard[i] - port[i]) / sum));
    }
}

void put_magnitudes(const std::vector<std::uint16_t>& magnitude, std::uint8_t* to) {
    wire::store_array<wire::ByteOrder::big>(std::span<const std::uint16_t>(magnitude), to);
}

void put_both(const std::vector<std::uint16_t>& magnitude, const std::vector<std::int16_t>& phase,
              std::uint8_t* to) {
    for (std::size_t i = 0; i < magnitude.size(); ++i) {
        wire::store<wire::ByteOrder::big>(magnitude[i], to + 4 * i);
        wire::store<wire::ByteOrder::big>(phase[i], to + 4 * i + 2);
    }
}

Plane make_plane(const PingRecord& ping, const Settings& settings, const Echogram& echogram,
                 const std::vector<std::size_t>& shown) {
    const bool with_phase = ping.controls.water_column == 2;
    const auto gain = gain_curve(ping.controls, settings, echogram, settings.acoustics.magnitude_reference);
    const std::size_t bins = echogram.shot.bins;
    Plane plane;
    plane.make(shown.size(), bins, with_phase ? 4 : 2);
    std::vector<float> row(bins);
    std::vector<std::uint16_t> magnitude(bins);
    std::vector<std::int16_t> phase(bins);
    for (std::size_t beam = 0; beam < plane.beams; ++beam) {
        amplitudes(echogram, shown[beam], gain, row.data());
        quantise(row.data(), bins, magnitude.data());
        if (with_phase) {
            phases(echogram, shown, beam, phase.data());
            put_both(magnitude, phase, plane.row(beam));
        } else {
            put_magnitudes(magnitude, plane.row(beam));
        }
    }
    return plane;
}

template <class Section>
void add_parts(const PingRecord& ping, const Plane& plane, std::vector<Bytes>& datagrams) {
    Section form;
    form.ping_number = ping.number;
    form.total_samples = static_cast<std::uint32_t>(plane.columns);
    form.total_beams = form.beams = static_cast<std::uint16_t>(plane.beams);
    const std::size_t most = std::max<std::size_t>(1, cells_per_datagram / plane.beams);
    for (std::size_t first = 0; first < plane.columns; first += most) {
        const std::size_t count = std::min(most, plane.columns - first);
        form.first_sample = static_cast<std::uint32_t>(first);
        form.samples = static_cast<std::uint16_t>(count);
        Bytes bytes = r2sonic::serialise(r2sonic::Wcd0Data{0, form});
        copy_columns(plane, first, count, bytes.data() + r2sonic::part_data_offset);
        datagrams.push_back(std::move(bytes));
    }
}

}  // namespace

std::vector<Bytes> water_column_datagrams(const PingRecord& ping, const Settings& settings,
                                          const Echogram& echogram) {
    if (ping.controls.water_column == 0) return {};
    r2sonic::Wcd0Head head;
    head.h0 = make_h0(ping, settings, echogram);
    const auto shown = shown_beams(echogram.beams());
    head.a1 = make_a1(ping, shown);
    std::vector<Bytes> datagrams{r2sonic::serialise(head)};
    const Plane plane = make_plane(ping, settings, echogram, shown);
    if (ping.controls.water_column == 2)
        add_parts<r2sonic::M2>(ping, plane, datagrams);
    else
        add_parts<r2sonic::M1>(ping, plane, datagrams);
    return datagrams;
}

}  // namespace echoloop::r2sonic_device
