// Reads a grid of heights or depths, of one of the formats that surveys come in, by GDAL. What the file does
// not say is taken from the user or guessed, and each guess is told.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/import/terrain/heights.h"

namespace echoloop::worlds {

/// What the user says of a survey. What is empty is taken from the file.
struct SurveyOptions {
    std::string layer{};            ///< of a file with several
    std::string units{};            ///< of its heights: "m", "ft", "us-ft", "fathom", "cm", "km"
    std::string positive{};         ///< "up" or "down"
    std::string crs{};              ///< as PROJ and GDAL understand: "EPSG:32632"
    bool local = false;             ///< its coordinates are metres east and north in the world
    bool local_if_unknown = false;  ///< where the file does not say what they are
    double water_level = 0;         ///< m: the file's height of what is z = 0 in the world
    std::optional<double> nodata{};
};

struct Survey {
    Heights heights{};                 ///< above the water level
    std::array<double, 6> affine{};    ///< as GDAL's geotransform, for the corners of cells around samples
    std::string crs{};                 ///< WKT; "": the coordinates are local
    double metres = 1;                 ///< of a unit of local coordinates
    std::vector<std::string> notes{};  ///< what was taken, and what was guessed
};

/// Throws Fault.
Survey read_survey(const std::filesystem::path& file, const SurveyOptions& options);

}  // namespace echoloop::worlds
