// The user's rules about which material things have: a YAML list, of which the first rule that fits counts.
//
//     - {model: "wreck.*", material: steel}                      # regular expressions over whole names
//     - {visual: "hull", mu_db: -15, reflection: 0.8}            # the keys of a scene's extras.sonar
//     - {script: "Gazebo/Wood.*", material: wood}
//     - {model: ocean, visual: surface, leave_out: true}
#pragma once

#include <filesystem>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "tools/import/world.h"

namespace echoloop::worlds {

/// What is known of a surface, all of it from the world's files.
struct Clues {
    std::string model{};  ///< "outer::inner" where models are nested
    std::string link{};
    std::string visual{};
    std::string script{};    ///< material script
    std::string mesh{};      ///< name of the mesh's file, without its folder
    std::string surface{};   ///< material's name in the mesh's file
    std::string property{};  ///< surface_props:material
    std::optional<double> laser_retro{};
    bool terrain = false;  ///< a heightmap
};

struct MaterialRule {
    std::vector<std::pair<std::string Clues::*, std::regex>> conditions{};
    Material material{};  ///< without a name
    bool leave_out = false;
    std::string place{};  ///< file and line
    bool used = false;
};

/// Throws Fault with file and line for what is no such list: unknown keys, expressions or materials.
std::vector<MaterialRule> read_material_rules(const std::filesystem::path& file);

/// The first that fits, which then is `used`; null: none.
MaterialRule* rule_for(const Clues& clues, std::vector<MaterialRule>& rules);

}  // namespace echoloop::worlds
