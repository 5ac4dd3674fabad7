// Which acoustic material a surface of a world has, and from where that is known or guessed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/import/material_rules.h"
#include "tools/import/world.h"

namespace echoloop::worlds {

struct Choice {
    Material material{};
    std::string from{};  ///< for the table: `rule materials.yaml:3`, `script "Gazebo/Steel"`, ...
    bool guessed = false;
    bool leave_out = false;  ///< a rule says so
};

/// In this order: the user's rules, surface_props, words in names that the table of materials knows, words
/// for things whose material can be guessed, laser_retro, else Mackenzie's -27 dB.
Choice choose_material(const Clues& clues, std::vector<MaterialRule>& rules);

/// The clue that says that a surface is the water's; empty: none does.
std::string sign_of_water(const Clues& clues);

/// Whether a name is that of a vehicle: its words, such as rov, auv, bluerov2.
bool is_name_of_robot(const std::string& name);

/// Whether a name is that of coordinate axes that somebody drew into a world.
bool is_name_of_axes(const std::string& name);

}  // namespace echoloop::worlds
