// Reads a grid of heights or depths, of one of the formats that surveys come in, by GDAL. What the file does
// not say is taken from the user or guessed, and each guess is told.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/import/terrain/heights.h"

namespace echoloop::worlds {

/// what() names the file, the reason and the remedy.
class TerrainError : public std::runtime_error {
  public:
    TerrainError(const std::filesystem::path& file, const std::string& reason, const std::string& remedy)
        : std::runtime_error(file.string() + ": " + reason + "; " + remedy) {}
};

/// What the user says of a survey. What is empty is taken from the file.
struct SurveyOptions {
    std::string layer{};     ///< of a file with several
    std::string units{};     ///< of its heights: "m", "ft", "us-ft", "fathom", "cm", "km"
    std::string positive{};  ///< "up" or "down"
    std::string crs{};       ///< as PROJ and GDAL understand: "EPSG:32632"
    bool local = false;      ///< its coordinates are metres east and north in the world
    double water_level = 0;  ///< m: the file's height of what is z = 0 in the world
    std::optional<double> nodata{};
};

struct Survey {
    Heights heights{};                 ///< above the water level
    std::array<double, 6> affine{};    ///< as GDAL's geotransform, for the corners of cells around samples
    std::string crs{};                 ///< WKT; "": the coordinates are local
    double metres = 1;                 ///< of a unit of local coordinates
    std::vector<std::string> notes{};  ///< what was taken, and what was guessed
};

/// Throws TerrainError.
Survey read_survey(const std::filesystem::path& file, const SurveyOptions& options);

}  // namespace echoloop::worlds
