// The acoustic material of a glTF material's name: Lambert's constant and mirror-like reflection from
// published densities and sound speeds. Knows no file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace echoloop {

/// Mackenzie's constant, 10 log10 mu, for what has no better value (JASA 33 (1961) 1498).
inline constexpr double default_mu_db = -27.0;
/// 10 log10(1/pi): a surface that scatters all that it receives.
inline constexpr double ceiling_mu_db = -4.9715;

/// 10 log10 mu of the first word in `name` that names a known material; words end at anything but a letter
/// and where a capital follows a small letter. Empty when no word is known.
///
/// Sand has Mackenzie's -27 dB. The others differ from it by their Rayleigh reflection coefficient at normal
/// incidence, 20 log10(|V| / |V_sand|) with V = (z - 1) / (z + 1) and z the impedance relative to water.
std::optional<double> mu_db_by_name(std::string_view name);

/// What the table says of a surface.
struct SurfaceProperties {
    double mu_db = default_mu_db;
    double reflection = 0;  ///< |V| at normal incidence
    double roughness = 0;   ///< m, rms height; own choice, see the table
    double slope = 0;       ///< rms slope of its facets in one direction; own choice, see the table
    bool lobe = false;      ///< as Material's
    double patchiness = 0;  ///< dB, as Material's; own choice, see the table
};

/// Of the first word in `name` that names a known material, as for mu_db_by_name().
std::optional<SurfaceProperties> surface_by_name(std::string_view name);

/// The first names of the table, for messages.
std::vector<std::string> known_materials();

/// The candidate with the fewest edits to `word`, or empty when none is near.
std::string nearest_of(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace echoloop
