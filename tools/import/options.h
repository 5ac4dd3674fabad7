// The arguments of `echoloop import`, once for its help and manual page and once for the program that does
// the work.
#pragma once

#include <array>

namespace echoloop::worlds {

struct ImportOption {
    enum class Kind { world, flag, value, repeated } kind;
    const char* name;
    const char* what;  ///< word for its value
    const char* help;
    bool required = false;
};

inline constexpr std::array options{
    ImportOption{
        ImportOption::Kind::world, "WORLD", "",
        "world or model (.sdf, .world, .urdf), surveys of the bottom (.tif, .asc, .grd, .nc, .xyz), or both",
        true},
    ImportOption{ImportOption::Kind::value, "--out", "FILE", "scene file to write (.glb)", true},
    ImportOption{
        ImportOption::Kind::repeated, "--model-path", "FOLDER",
        "where model:// and package:// are looked for, beside GZ_SIM_RESOURCE_PATH and GAZEBO_MODEL_PATH; "
        "may be "
        "repeated"},
    ImportOption{ImportOption::Kind::value, "--materials", "FILE",
                 "rules (YAML) that say which material things have"},
    ImportOption{ImportOption::Kind::repeated, "--without", "MODEL",
                 "leave a model out, such as the robot itself; may be repeated"},
    ImportOption{ImportOption::Kind::repeated, "--keep", "MODEL",
                 "keep a model that would be left out as a robot or as water; may be repeated"},
    ImportOption{ImportOption::Kind::flag, "--allow-missing", "",
                 "leave out what cannot be had or read, and say so, where it is an error otherwise"},
    ImportOption{ImportOption::Kind::value, "--heading", "DEG",
                 "how far the world's x points from east to north, in place of its heading_deg"},
    ImportOption{ImportOption::Kind::value, "--origin", "LAT,LON",
                 "surveys: place on the Earth of x = 0, y = 0, unless the world says it"},
    ImportOption{ImportOption::Kind::value, "--crs", "EPSG:N",
                 "surveys: reference system of their coordinates"},
    ImportOption{ImportOption::Kind::flag, "--local", "",
                 "surveys: their coordinates are metres east and north in the world"},
    ImportOption{ImportOption::Kind::value, "--layer", "NAME", "surveys: of several in a file"},
    ImportOption{ImportOption::Kind::value, "--units", "UNIT",
                 "surveys: of their heights: m, ft, us-ft, fathom, cm or km"},
    ImportOption{ImportOption::Kind::value, "--positive", "WAY", "surveys: up for heights, down for depths"},
    ImportOption{ImportOption::Kind::value, "--water-level", "M",
                 "surveys: their height of what is z = 0 (0)"},
    ImportOption{ImportOption::Kind::value, "--nodata", "VALUE",
                 "surveys: value that means that nothing was measured"},
    ImportOption{ImportOption::Kind::value, "--error", "M",
                 "surveys: how far a sample may be above or below the triangles (0.1)"},
    ImportOption{ImportOption::Kind::value, "--triangles", "N", "surveys: at most so many (1000000)"},
    ImportOption{ImportOption::Kind::value, "--material", "NAME",
                 "surveys: what the bottom is made of, or a typical seabed (sand)"},
    ImportOption{ImportOption::Kind::flag, "--json", "", "print the table as one JSON document"},
};

}  // namespace echoloop::worlds
