// Makes a world of what libsdformat reads: models, links, joints and visuals become nodes.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/import/guard.h"
#include "tools/import/material_rules.h"
#include "tools/import/model_paths.h"
#include "tools/import/report.h"
#include "tools/import/sources.h"
#include "tools/import/world.h"

namespace echoloop::worlds {

struct SdfChoices {
    std::vector<std::string> without{}, keep{};  ///< names of models
    std::vector<MaterialRule> rules{};
    bool allow_missing = false;
    std::optional<double> heading{};  ///< deg, of the world's x from east to north; empty: as the world says
};

/// Of the world's shapes, how many are read.
using Told = std::function<void(std::size_t done, std::size_t of)>;

/// Throws StartError for the world in the file where this program was built without libsdformat.
void require_sdf(const std::filesystem::path& world);

/// Reads the copy. Nodes are named model, model::link, model::joint and model::link::visual. Throws Fault.
void add_sdf(const Sources& sources, const ModelPaths& paths, SdfChoices& choices, World& world,
             Report& report, Stage& stage, const Told& told);

}  // namespace echoloop::worlds
