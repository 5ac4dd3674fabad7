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
    ImportOption{ImportOption::Kind::world, "WORLD", "", "world or model: .sdf, .world or .urdf", true},
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
    ImportOption{ImportOption::Kind::flag, "--json", "", "print the table as one JSON document"},
};

}  // namespace echoloop::worlds
