#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "emulator/devices/norbit-wbms/packets.h"
#include "protocols/norbit/codec.h"
#include "protocols/wire/bytes.h"

namespace echoloop::norbit_device {
namespace {

constexpr std::size_t most_samples = 512 * 1024;  // of an image, the document

/// How beams and bins of an echogram become columns and rows: row r is the mean around the bin at the time of
/// its sample, so that ranges need no half row.
struct Grid {
    std::size_t beams_per_column = 1, columns = 0;
    std::size_t bins_per_row = 1, first_row = 0, rows = 0;

    /// Bins [first, last) of row r.
    std::pair<std::size_t, std::size_t> bins_of(std::size_t r, const Plan& plan) const {
        const auto middle = static_cast<std::ptrdiff_t>((first_row + r) * bins_per_row - plan.first_bin);
        const auto before = static_cast<std::ptrdiff_t>(bins_per_row / 2);
        const auto last = static_cast<std::ptrdiff_t>(plan.bins);
        const auto from = std::clamp<std::ptrdiff_t>(middle - before, 0, last - 1);
        const auto to = std::clamp<std::ptrdiff_t>(
            middle - before + static_cast<std::ptrdiff_t>(bins_per_row), from + 1, last);
        return {static_cast<std::size_t>(from), static_cast<std::size_t>(to)};
    }
};

std::size_t bytes_of_image(std::size_t rows, std::size_t columns, norbit::Sample sample) {
    return rows * columns * norbit::bytes_of(sample) + 4 * columns;
}

/// The whole number of bins a row that comes closest to the rows asked for, within what a packet holds.
Grid make_grid(const PingRecord& ping, const Settings& s) {
    const std::size_t beams = ping.plan.bearings.size();
    Grid g;
    g.columns = std::min(beams, static_cast<std::size_t>(ping.controls.horizontal_resolution));
    g.beams_per_column = beams / g.columns;
    const double ideal = static_cast<double>(ping.plan.bins) / ping.controls.vertical_resolution;
    g.bins_per_row = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(ideal)));
    while (true) {
        g.first_row = (ping.plan.first_bin + g.bins_per_row / 2) / g.bins_per_row;
        g.rows = (ping.plan.first_bin + ping.plan.bins) / g.bins_per_row - g.first_row;
        g.rows = std::max<std::size_t>(1, g.rows);
        const std::size_t head = norbit::water_column_head - 24;
        if (g.rows * g.columns <= most_samples &&
            head + bytes_of_image(g.rows, g.columns, s.sample) <= norbit::max_payload)
            return g;
        ++g.bins_per_row;
    }
}

using Stretch = std::pair<std::size_t, std::size_t>;

/// The bins of each row. Rows [first, last) have all of theirs, one row's behind the other's; at the window's
/// ends some are missing.
struct Stretches {
    std::vector<Stretch> rows;
    std::size_t first = 0, last = 0;
};

Stretches stretches_of(const Grid& g, const Plan& plan) {
    Stretches s;
    for (std::size_t r = 0; r < g.rows; ++r) s.rows.push_back(g.bins_of(r, plan));
    const auto whole = [&](std::size_t r) { return s.rows[r].second - s.rows[r].first == g.bins_per_row; };
    while (s.first < g.rows && !whole(s.first)) ++s.first;
    s.last = s.first;
    while (s.last < g.rows && whole(s.last) &&
           s.rows[s.last].first == s.rows[s.first].first + (s.last - s.first) * g.bins_per_row)
        ++s.last;
    return s;
}

/// Adds to every row its share of one beam: the mean of its bins over `beams`.
void add_beam(std::span<const float> bins, const Stretches& s, std::size_t per_row, std::size_t beams,
              std::span<float> out) {
    const auto add_slowly = [&](std::size_t r) {
        const auto [from, to] = s.rows[r];
        float sum = 0;
        for (std::size_t i = from; i < to; ++i) sum += bins[i];
        out[r] += sum / static_cast<float>((to - from) * beams);
    };
    for (std::size_t r = 0; r < s.first; ++r) add_slowly(r);
    for (std::size_t r = s.last; r < out.size(); ++r) add_slowly(r);
    const std::size_t parts = per_row * beams;
    if (per_row > 2 || !std::has_single_bit(parts)) {
        for (std::size_t r = s.first; r < s.last; ++r) add_slowly(r);
        return;
    }
    if (s.first == s.last) return;
    const float share = 1 / static_cast<float>(parts);  // exact
    const float* from = bins.data() + s.rows[s.first].first;
    float* to = out.data() + s.first;
    const std::size_t rows = s.last - s.first;
    if (per_row == 1)
        for (std::size_t r = 0; r < rows; ++r) to[r] += from[r] * share;
    else
        for (std::size_t r = 0; r < rows; ++r) to[r] += (from[2 * r] + from[2 * r + 1]) * share;
}

/// Makes amplitudes of powers, each with its gain; the greatest of them. Roots keep the order of powers.
float to_amplitudes(std::span<float> values, std::span<const float> gain) {
    constexpr std::size_t lanes = 16;
    std::array<float, lanes> most{};
    std::size_t i = 0;
    for (; i + lanes <= values.size(); i += lanes) {
        float* const some = &values[i];
        for (std::size_t k = 0; k < lanes; ++k) some[k] *= gain[i + k];
        for (std::size_t k = 0; k < lanes; ++k) most[k] = most[k] < some[k] ? some[k] : most[k];
        for (std::size_t k = 0; k < lanes; ++k) some[k] = std::sqrt(some[k]);
    }
    for (; i < values.size(); ++i) {
        const float power = values[i] * gain[i];
        most[0] = std::max(most[0], power);
        values[i] = std::sqrt(power);
    }
    return std::sqrt(*std::max_element(most.begin(), most.end()));
}

/// Amplitudes of one column, at full scale 1 and before they are cut; the greatest of them. `gain` is of
/// power, one a row.
float fill_column(const Echogram& echogram, const Grid& g, const Stretches& stretches, std::size_t column,
                  const std::vector<float>& gain, std::span<float> out) {
    std::fill(out.begin(), out.end(), 0.0F);
    const std::size_t first = column * g.beams_per_column;
    for (std::size_t beam = first; beam < first + g.beams_per_column; ++beam)
        add_beam(echogram.beam(beam), stretches, g.bins_per_row, g.beams_per_column, out);
    if (echogram.rule == EchoRule::cerqueira2016) return *std::max_element(out.begin(), out.end());
    return to_amplitudes(out, gain);
}

/// As they are in memory.
template <class T>
T sample_of(float amplitude) {
    if constexpr (std::is_floating_point_v<T>) {
        return amplitude;
    } else {
        const auto most = static_cast<float>(std::numeric_limits<T>::max());
        return static_cast<T>(static_cast<std::int32_t>(std::min(1.0F, amplitude) * most + 0.49F));
    }
}

/// Columns that are written together, since those of one row lie side by side in the image.
constexpr std::size_t columns_at_once = 32;

/// `amplitudes`: of `count` columns, `rows` each, that go into a row's samples from `to` on.
template <class T>
void store_columns(std::span<const float> amplitudes, std::size_t count, std::size_t rows,
                   std::size_t columns, std::uint8_t* to) {
    constexpr std::size_t rows_at_once = 64;
    std::array<T, columns_at_once * rows_at_once> turned;
    for (std::size_t first = 0; first < rows; first += rows_at_once) {
        const std::size_t some = std::min(rows_at_once, rows - first);
        for (std::size_t n = 0; n < count; ++n)
            for (std::size_t r = 0; r < some; ++r)
                turned[n * rows_at_once + r] = sample_of<T>(amplitudes[n * rows + first + r]);
        for (std::size_t r = 0; r < some; ++r, to += columns * sizeof(T))
            for (std::size_t n = 0; n < count; ++n)
                wire::store<wire::ByteOrder::little>(turned[n * rows_at_once + r], to + n * sizeof(T));
    }
}

void store_columns(norbit::Sample sample, std::span<const float> amplitudes, std::size_t count, const Grid& g,
                   std::uint8_t* to) {
    if (sample == norbit::Sample::u8)
        store_columns<std::uint8_t>(amplitudes, count, g.rows, g.columns, to);
    else if (sample == norbit::Sample::u16)
        store_columns<std::uint16_t>(amplitudes, count, g.rows, g.columns, to);
    else if (sample == norbit::Sample::f32)
        store_columns<float>(amplitudes, count, g.rows, g.columns, to);
    else
        store_columns<std::int16_t>(amplitudes, count, g.rows, g.columns, to);
}

/// On power, of every row: analog and digital gain against full scale.
std::vector<float> row_gains(const PingRecord& ping, const Settings& s, const Grid& g) {
    const Vga vga = make_vga(ping.controls, ping.plan, s);
    const double row_time = static_cast<double>(g.bins_per_row) / ping.plan.bin_rate();
    std::vector<float> gains(g.rows);
    for (std::size_t r = 0; r < g.rows; ++r) {
        const double analog = vga.at(static_cast<double>(g.first_row + r) * row_time);
        gains[r] = static_cast<float>(
            std::pow(10.0, (analog + ping.plan.digital_gain - s.acoustics.full_scale) / 10));
    }
    return gains;
}

std::uint32_t vga_word(double gain, const Settings& s) {
    if (s.whole_vga_gains) return static_cast<std::uint32_t>(std::lround(gain));
    return std::bit_cast<std::uint32_t>(static_cast<float>(gain));
}

norbit::WaterColumn head_of(const PingRecord& ping, const Settings& s, const Grid& g, double sent) {
    const auto f = [](double value) { return static_cast<float>(value); };
    const Controls& c = ping.controls;
    const double rate = ping.plan.bin_rate() / static_cast<double>(g.bins_per_row);
    const double unit = s.hertz_in_water_column ? 1000 : 1;
    const Vga vga = make_vga(c, ping.plan, s);
    norbit::WaterColumn w;
    w.sound_speed = f(ping.plan.sound_speed);
    w.sample_rate = f(rate);
    w.beams = static_cast<std::uint32_t>(g.columns);
    w.samples = static_cast<std::uint32_t>(g.rows);
    w.transmit_time = ping.transmitted;
    w.sample = s.sample;
    w.t0 = static_cast<std::int32_t>(g.first_row);
    w.gain = f(ping.plan.digital_gain);
    w.swath_direction = f(ping.plan.direction);
    w.swath_opening = f(ping.plan.opening);
    w.frequency = f(unit * c.frequency);
    w.bandwidth = f(unit * c.bandwidth);
    w.pulse = f(1e-6 * c.pulse);
    w.amplitude = static_cast<std::uint32_t>(c.amplitude);
    w.ping_rate = f(1 / ping.plan.period);
    w.ping = ping.number;
    w.send_time = sent;
    w.beamformer_beams = static_cast<std::uint32_t>(ping.plan.bearings.size());
    w.t1 = static_cast<std::int32_t>(std::lround(vga.t1 * rate));
    w.g1 = vga_word(vga.g1, s);
    w.t2 = static_cast<std::int32_t>(std::lround(std::min(vga.t2 * rate, 1e9)));
    w.g2 = vga_word(vga.g2, s);
    w.tx_angle = f(deg_to_rad(c.tx_direction));
    w.tx_voltage = std::numeric_limits<float>::quiet_NaN();
    w.beam_mode = s.beam_mode;
    w.sonar_mode = c.mode == 0 ? norbit::SonarMode::forward_looking : norbit::SonarMode::bathymetry;
    w.gate_tilt = f(deg_to_rad(c.gate_tilt));
    return w;
}

/// Middle of a column's beams, as it stands on the wire.
float column_angle(const Plan& plan, const Grid& g, std::size_t column) {
    const std::size_t first = column * g.beams_per_column, last = first + g.beams_per_column - 1;
    return static_cast<float>(plan.sign * (plan.bearings[first] + plan.bearings[last]) / 2);
}

}  // namespace

Bytes water_column_packet(const PingRecord& ping, const Settings& s, const Echogram& echogram, double sent,
                          double& peak) {
    const Grid g = make_grid(ping, s);
    Bytes packet = norbit::open(head_of(ping, s, g, sent), s.version);
    const std::size_t size = norbit::bytes_of(s.sample);
    std::uint8_t* const image = packet.data() + norbit::water_column_head;
    std::uint8_t* const angles = image + g.rows * g.columns * size;
    const std::vector<float> gains = row_gains(ping, s, g);
    const Stretches stretches = stretches_of(g, ping.plan);
    std::vector<float> block(columns_at_once * g.rows);
    float loudest = 0;
    for (std::size_t first = 0; first < g.columns; first += columns_at_once) {
        const std::size_t count = std::min(columns_at_once, g.columns - first);
        for (std::size_t n = 0; n < count; ++n)
            loudest = std::max(loudest, fill_column(echogram, g, stretches, first + n, gains,
                                                    std::span(block).subspan(n * g.rows, g.rows)));
        store_columns(s.sample, std::span(block).first(count * g.rows), count, g, image + first * size);
    }
    for (std::size_t n = 0; n < g.columns; ++n)
        wire::store<wire::ByteOrder::little>(column_angle(ping.plan, g, n), angles + 4 * n);
    peak = loudest;
    norbit::close(packet);
    return packet;
}

}  // namespace echoloop::norbit_device
