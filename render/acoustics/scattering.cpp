#include "render/acoustics/scattering.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace echoloop {
namespace {

constexpr double degree = std::numbers::pi / 180;

double decibel(double power) { return 10 * std::log10(power); }

double curve_db(const std::vector<BackscatterPoint>& curve, double grazing_deg) {
    const BackscatterPoint &first = curve.front(), &last = curve.back();
    if (grazing_deg >= last.grazing_deg) return last.strength_db;
    if (grazing_deg <= first.grazing_deg) {
        if (first.grazing_deg <= 0) return first.strength_db;
        return first.strength_db +
               2 * decibel(std::sin(grazing_deg * degree) / std::sin(first.grazing_deg * degree));
    }
    const auto after =
        std::upper_bound(curve.begin(), curve.end(), grazing_deg,
                         [](double angle, const auto& point) { return angle < point.grazing_deg; });
    const auto before = after - 1;
    const double share = (grazing_deg - before->grazing_deg) / (after->grazing_deg - before->grazing_deg);
    return before->strength_db + share * (after->strength_db - before->strength_db);
}

}  // namespace

double backscatter_db(const Material& material, double grazing) {
    if (!material.backscatter.empty()) return curve_db(material.backscatter, grazing / degree);
    return material.mu_db + 2 * decibel(std::sin(grazing));
}

StrengthTable::StrengthTable(const Material& material) {
    const auto& curve = material.backscatter;
    const auto bad = std::adjacent_find(curve.begin(), curve.end(), [](const auto& a, const auto& b) {
        return !(a.grazing_deg < b.grazing_deg);
    });
    if (bad != curve.end())
        throw std::invalid_argument("backscatter of " + material.name + ": grazing angles must ascend");
    for (std::size_t i = 1; i <= cells; ++i) {
        const double cosine = static_cast<double>(i) / cells;  // of incidence: the sine of the grazing angle
        values_[i] =
            static_cast<float>(std::pow(10, backscatter_db(material, std::asin(cosine)) / 10) / cosine);
    }
    values_[0] = curve.empty() || curve.front().grazing_deg > 0 ? 0 : values_[1];
}

}  // namespace echoloop
