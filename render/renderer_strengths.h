// How strongly the surfaces of a scene, and the water's, send sound back at a ping's frequency: tables that
// are kept from ping to ping.
#pragma once

#include <span>
#include <vector>

#include "render/acoustics/scattering.h"
#include "render/recently_used.h"
#include "render/scene/scene.h"

namespace echoloop {

class SurfaceStrengths {
  public:
    explicit SurfaceStrengths(const Scene& scene);

    /// Begins anew for a ping. `wavenumber`: rad/m, where facets' lobes count, which are those of the mirrors
    /// that multipath is about; else 0.
    void find(double wavenumber);
    /// Puts the water's surface behind those of the scene; returns its number, as Pixel::surface.
    /// `frequency`: Hz, `wind`: m/s.
    std::size_t add_water_surface(double frequency, double wind);
    /// By Pixel::surface - 1; until the next call.
    std::span<const StrengthTable* const> of_surfaces() const { return strength_; }

  private:
    struct Known {
        double wavenumber;
        std::vector<StrengthTable> tables;  ///< per material
    };
    struct WaterSurface {
        double frequency, wind;
        StrengthTable table;
    };

    const Scene& scene_;
    std::vector<std::uint32_t> material_of_surface_;  ///< index into Scene::materials()
    RecentlyUsed<Known> tables_{8};
    RecentlyUsed<WaterSurface> water_tables_{8};
    std::vector<const StrengthTable*> strength_;
};

}  // namespace echoloop
