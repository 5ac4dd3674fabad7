#include "render/renderer_strengths.h"

#include "render/acoustics/sea_surface.h"

namespace echoloop {

SurfaceStrengths::SurfaceStrengths(const Scene& scene) : scene_(scene) {
    for (const SceneSurface& surface : scene.surfaces()) material_of_surface_.push_back(surface.material);
}

void SurfaceStrengths::find(double wavenumber) {
    const auto& tables = tables_
                             .get([&](const Known& known) { return known.wavenumber == wavenumber; },
                                  [&] {
                                      Known made{wavenumber, {}};
                                      for (const Material& material : scene_.materials())
                                          made.tables.emplace_back(material, wavenumber);
                                      return std::pair(std::move(made), std::size_t{1});
                                  })
                             .tables;
    strength_.clear();
    for (const std::uint32_t material : material_of_surface_) strength_.push_back(&tables[material]);
}

std::size_t SurfaceStrengths::add_water_surface(double frequency, double wind) {
    const auto fits = [&](const WaterSurface& known) {
        return known.frequency == frequency && known.wind == wind;
    };
    const auto make = [&] {
        const auto at = [&](double sine) { return surface_backscatter(frequency, wind, sine); };
        return std::pair(WaterSurface{frequency, wind, StrengthTable(at)}, std::size_t{1});
    };
    strength_.push_back(&water_tables_.get(fits, make).table);
    return strength_.size();
}

}  // namespace echoloop
