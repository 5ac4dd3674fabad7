#include "render/acoustics/stave_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "render/acoustics/random.h"

namespace echoloop {
namespace {

using std::numbers::pi;

constexpr std::uint32_t stave_kind = 0x57A7E;  ///< of RandomStream

/// Values of the table for each lobe, whose real and imaginary parts are linear between them.
constexpr double values_per_lobe = 6;

/// As AperturePattern has them.
double weight_of(ApertureShape shape, std::size_t stave, std::size_t staves) {
    if (shape != ApertureShape::hamming || staves < 2) return 1;
    return 0.54 - 0.46 * std::cos(2 * pi * static_cast<double>(stave) / static_cast<double>(staves - 1));
}

/// A filter of unit energy that makes white numbers alike by exp(-(k / `staves`)^2), k staves apart.
std::vector<double> shares_of_neighbours(double staves) {
    const auto side = static_cast<int>(std::ceil(2 * staves));
    std::vector<double> shares;
    double energy = 0;
    for (int k = -side; k <= side; ++k) {
        shares.push_back(k == 0 ? 1 : std::exp(-2 * std::pow(k / staves, 2)));
        energy += shares.back() * shares.back();
    }
    for (double& share : shares) share /= std::sqrt(energy);
    return shares;
}

/// Complex numbers that turn by an angle of their own at every step. In lanes, which vectorise.
class Phasors {
  public:
    explicit Phasors(std::size_t count) : groups_((count + lanes - 1) / lanes) {}

    void set(std::size_t i, std::complex<double> value, std::complex<double> turn) {
        Group& group = groups_[i / lanes];
        group.real[i % lanes] = value.real(), group.imaginary[i % lanes] = value.imag();
        group.turn_real[i % lanes] = turn.real(), group.turn_imaginary[i % lanes] = turn.imag();
    }

    std::complex<double> sum_and_turn() {
        double real[lanes] = {}, imaginary[lanes] = {};
        for (Group& g : groups_)
            for (std::size_t k = 0; k < lanes; ++k) {
                const double re = g.real[k], im = g.imaginary[k];
                real[k] += re, imaginary[k] += im;
                g.real[k] = re * g.turn_real[k] - im * g.turn_imaginary[k];
                g.imaginary[k] = re * g.turn_imaginary[k] + im * g.turn_real[k];
            }
        return {std::accumulate(real, real + lanes, 0.0), std::accumulate(imaginary, imaginary + lanes, 0.0)};
    }

  private:
    static constexpr std::size_t lanes = 8;
    struct Group {
        double real[lanes] = {}, imaginary[lanes] = {}, turn_real[lanes] = {}, turn_imaginary[lanes] = {};
    };
    std::vector<Group> groups_;
};

}  // namespace

StaveErrors::StaveErrors(const AperturePattern& ideal, std::size_t staves, const ArrayErrors& errors,
                         double alike)
    : ideal_(ideal) {
    const double length = ideal.length_in_wavelengths();
    if (staves < 2) staves = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(2 * length)));
    const std::vector<double> shares = shares_of_neighbours(alike * static_cast<double>(staves) / length);
    const std::size_t sources = staves + shares.size() - 1;
    std::vector<float> numbers(normals_room(2 * sources));  // an amplitude's and a phase's for each
    const float* z =
        numbers.data() + normals({errors.unit, 0, 0, stave_kind}, 0, 2 * sources, numbers.data());

    const auto half = static_cast<std::size_t>(std::ceil(values_per_lobe * length));
    step_ = 1 / static_cast<double>(half);
    Phasors phasors(staves);
    double sum = 0, squares = 0;
    for (std::size_t n = 0; n < staves; ++n) {
        const double weight = weight_of(ideal.shape(), n, staves);
        sum += weight, squares += weight * weight;
        double level = 0, angle = 0;
        for (std::size_t k = 0; k < shares.size(); ++k) {
            level += errors.amplitude * shares[k] * static_cast<double>(z[2 * (n + k)]);
            angle += errors.phase * shares[k] * static_cast<double>(z[2 * (n + k) + 1]);
        }
        const std::complex<double> wrong = weight * (std::polar(std::pow(10, level / 20), angle) - 1.0);
        const double place = (static_cast<double>(n) - 0.5 * static_cast<double>(staves - 1)) * length /
                             static_cast<double>(staves);
        phasors.set(n, wrong * std::polar(1.0, -2 * pi * place), std::polar(1.0, 2 * pi * place * step_));
    }
    for (std::size_t i = 0; i < 2 * half + 2; ++i) table_.emplace_back(phasors.sum_and_turn() / sum);
    effective_ = sum * sum / squares;
    main_lobe_ = std::norm(1.0F + table_[half]);
}

double StaveErrors::power(double angle) const {
    const double amplitude = ideal_.amplitude(angle);
    if (std::cos(angle) < 0) return amplitude * amplitude;
    const double at = (std::sin(angle) + 1) / step_;
    const auto lower = std::min(static_cast<std::size_t>(at), table_.size() - 2);
    const auto share = static_cast<float>(at - static_cast<double>(lower));
    const std::complex<float> wrong = table_[lower] + share * (table_[lower + 1] - table_[lower]);
    return static_cast<double>(std::norm(static_cast<float>(amplitude) + wrong) / main_lobe_);
}

std::complex<float> StaveErrors::at_sine(double sine) const {
    const double at = (sine + 1) / step_;
    const auto lower = std::min(static_cast<std::size_t>(at), table_.size() - 2);
    const auto share = static_cast<float>(at - static_cast<double>(lower));
    const std::complex<float> wrong = table_[lower] + share * (table_[lower + 1] - table_[lower]);
    return (static_cast<float>(ideal_.at_sine(sine)) + wrong) / std::sqrt(main_lobe_);
}

}  // namespace echoloop
