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

double facet_lobe(const Material& material, double wavenumber, double cosine) {
    constexpr double least_slope = 0.02;
    if (!material.lobe || !material.backscatter.empty() || !(cosine > 0)) return 0;
    const double slope = std::max(material.slope, least_slope);
    const double square = slope * slope + material.mesh_slope * material.mesh_slope;
    const double rayleigh = 2 * wavenumber * material.roughness * cosine;
    const double incoherent = material.mesh_slope > 0 ? 1 : -std::expm1(-rayleigh * rayleigh);
    const double cosine2 = cosine * cosine;
    return incoherent * material.reflection * material.reflection /
           (8 * std::numbers::pi * square * cosine2 * cosine2) * std::exp(-(1 / cosine2 - 1) / (2 * square));
}

StrengthTable::StrengthTable(const Material& material, double wavenumber) {
    const auto& curve = material.backscatter;
    const auto bad = std::adjacent_find(curve.begin(), curve.end(), [](const auto& a, const auto& b) {
        return !(a.grazing_deg < b.grazing_deg);
    });
    if (bad != curve.end())
        throw std::invalid_argument("backscatter of " + material.name + ": grazing angles must ascend");
    for (std::size_t i = 1; i <= cells; ++i) {
        const double cosine = static_cast<double>(i) / cells;  // of incidence: the sine of the grazing angle
        const double diffuse = std::pow(10, backscatter_db(material, std::asin(cosine)) / 10);
        const double lobe = wavenumber > 0 ? facet_lobe(material, wavenumber, cosine) : 0;
        values_[i] = static_cast<float>((diffuse + lobe) / cosine);
    }
    values_[0] = curve.empty() || curve.front().grazing_deg > 0 ? 0 : values_[1];
}

StrengthTable::StrengthTable(const std::function<double(double cosine)>& strength) {
    for (std::size_t i = 1; i <= cells; ++i) {
        const double cosine = static_cast<double>(i) / cells;
        values_[i] = static_cast<float>(strength(cosine) / cosine);
    }
    values_[0] = values_[1];
}

}  // namespace echoloop
