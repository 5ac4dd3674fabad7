#include "emulator/devices/oculus/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "protocols/wire/bytes.h"

namespace echoloop::oculus_device {
namespace {

constexpr std::size_t most_beams = 512;
constexpr std::size_t rows_at_once = 16;  // floats of a cache line
constexpr double most_gain = 96;          // dB of the greatest gain word of 32 bits

using Row = std::array<float, most_beams>;

/// Share of full scale by gamma: (x^2)^(gamma / 2) of x^2 in 0..1.
class Gamma {
  public:
    explicit Gamma(double gamma) : gamma_(gamma) {
        if (gamma == 1 || gamma == 0.5) return;
        // Over the fourth root of x^2, so that the dark end has fine steps too.
        for (std::size_t i = 0; i < table_.size(); ++i)
            table_[i] = static_cast<float>(std::pow(static_cast<double>(i) / last, 2 * gamma));
    }

    void apply(std::span<float> squares) const {
        if (gamma_ == 1) {
            for (float& x : squares) x = std::sqrt(x);
        } else if (gamma_ == 0.5) {
            for (float& x : squares) x = std::sqrt(std::sqrt(x));
        } else {
            look_up(squares);
        }
    }

  private:
    static constexpr std::int32_t last = 1024;

    /// In two loops: the compiler makes vectors of all but what a table holds.
    void look_up(std::span<float> squares) const {
        std::array<std::int32_t, most_beams> step;
        for (std::size_t i = 0; i < squares.size(); ++i) {
            const float at = std::max(0.0F, std::sqrt(std::sqrt(squares[i])) * static_cast<float>(last));
            step[i] = static_cast<std::int32_t>(at);
            squares[i] = at - static_cast<float>(step[i]);
        }
        for (std::size_t i = 0; i < squares.size(); ++i) {
            const float* at = &table_[static_cast<std::size_t>(step[i])];
            squares[i] = at[0] + (at[1] - at[0]) * squares[i];
        }
    }

    double gamma_;
    std::array<float, last + 2> table_{};  ///< with one more, for what is behind the last step
};

/// Small numbers by way of an int, which vectors have.
template <class T>
T to_steps(float value) {
    if constexpr (sizeof(T) < 4) return static_cast<T>(static_cast<std::int32_t>(value));
    return static_cast<T>(value);
}

template <class T>
void store_samples(std::span<const float> shares, double full_scale, bool mirrored, std::uint8_t* out) {
    // Beyond 24 bits a float has steps of its own, and its full scale must not round up to 2^32.
    const auto scale = static_cast<float>(full_scale);
    std::array<T, most_beams> samples;
    for (std::size_t i = 0; i < shares.size(); ++i) samples[i] = to_steps<T>(shares[i] * scale + 0.5F);
    if (mirrored) std::reverse(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(shares.size()));
    wire::store_array<wire::ByteOrder::little>(std::span<const T>(samples.data(), shares.size()), out);
}

void store_row(std::span<const float> shares, oculus::DataSize size, bool mirrored, std::uint8_t* out) {
    if (size == oculus::DataSize::bits8)
        store_samples<std::uint8_t>(shares, 254, mirrored, out);  // real 8-bit images use 0..254
    else if (size == oculus::DataSize::bits16)
        store_samples<std::uint16_t>(shares, 65535, mirrored, out);
    else
        store_samples<std::uint32_t>(shares, 4294967040.0, mirrored, out);
}

/// The gain that keeps the strongest echo of a row within full scale.
std::uint32_t assisted(std::uint32_t gain, float strongest, double unit) {
    if (!(strongest * unit * gain > 1)) return gain;
    return static_cast<std::uint32_t>(std::max(1.0, 1 / (strongest * unit)));
}

void store_gain(std::uint32_t gain, bool as_float, std::uint8_t* out) {
    if (as_float)
        wire::store<wire::ByteOrder::little>(static_cast<float>(gain), out);
    else
        wire::store<wire::ByteOrder::little>(gain, out);
}

/// Rows `first` to `first + count` of the echogram, all beams of a row together.
void turn(const Echogram& echogram, std::size_t first, std::size_t count,
          std::array<Row, rows_at_once>& rows) {
    for (std::size_t beam = 0; beam < echogram.beams(); ++beam) {
        const float* levels = echogram.beam(beam).data() + first;
        for (std::size_t r = 0; r < count; ++r) rows[r][beam] = levels[r];
    }
}

}  // namespace

namespace {

/// dB of the gain word without gain and time-varied gain: as high as the greatest allows, since words are
/// whole.
double floor_gain(const Acoustics& a, const ModeFigures& mode) {
    return most_gain - a.gain_span - mode.tvg_limit;
}

}  // namespace

std::uint32_t row_gain(double range, const Request& request, const Plan& plan, const Settings& settings) {
    const Acoustics& a = settings.acoustics;
    const ModeFigures& mode = figures_of(request, a);
    const double r = std::max(range, mode.tvg_nearest);
    const double tvg = a.tvg_spreading * std::log10(r) + 2 * mode.tvg_absorption * r;
    const double db = floor_gain(a, mode) + a.gain_span * plan.gain / 100 +
                      (settings.tvg ? std::min(tvg, mode.tvg_limit) : 0);
    return static_cast<std::uint32_t>(std::lround(std::min(std::pow(10.0, db / 10), 4294967295.0)));
}

void write_image(const Echogram& echogram, const Request& request, const Plan& plan, const Settings& settings,
                 std::span<std::uint8_t> out) {
    const bool words = request.has(oculus::flag::gain_words), assist = request.has(oculus::flag::gain_assist);
    const bool paper = echogram.rule == EchoRule::cerqueira2016;
    const std::size_t stride = out.size() / plan.rows, head = words ? 4 : 0;
    const ModeFigures& mode = figures_of(request, settings.acoustics);
    const double unit = std::pow(10.0, -(mode.reference_level + floor_gain(settings.acoustics, mode)) / 10);
    const Gamma gamma(request.gamma());
    std::array<Row, rows_at_once> block;
    for (std::size_t row = 0; row < plan.rows; ++row) {
        if (row % rows_at_once == 0) turn(echogram, row, std::min(rows_at_once, plan.rows - row), block);
        const std::span<float> shares(block[row % rows_at_once].data(), plan.beams);
        std::uint32_t gain =
            row_gain((static_cast<double>(row) + 0.5) * plan.resolution(), request, plan, settings);
        if (assist && !paper) gain = assisted(gain, *std::max_element(shares.begin(), shares.end()), unit);
        const auto factor = static_cast<float>(unit * gain);
        for (float& x : shares) x = std::min(1.0F, paper ? x * x : x * factor);
        gamma.apply(shares);
        std::uint8_t* at = out.data() + row * stride;
        if (words) store_gain(gain, settings.float_gain_words, at);
        store_row(shares, plan.data_size, settings.starboard_negative, at + head);
    }
}

}  // namespace echoloop::oculus_device
