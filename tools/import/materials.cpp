#include "tools/import/materials.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "render/scene/materials.h"
#include "tools/import/fault.h"

namespace echoloop::worlds {
namespace {

/// Things and what they are usually made of: own choice.
struct Thing {
    const char* material;
    std::set<std::string> words;
};
const std::vector<Thing>& things() {
    static const std::vector<Thing> all{
        {"sand",
         {"seabed", "seafloor", "bottom", "heightmap", "terrain", "bathymetry", "seamount", "dune",
          "ground"}},
        {"steel",
         {"wreck", "shipwreck", "ship", "vessel", "hull", "pipe", "pipes", "pipeline", "anchor", "manifold",
          "bop", "valve", "wellhead", "flange", "propeller", "torpedo", "container", "barrel"}},
        {"concrete", {"pool", "pier", "dock", "quay", "wall", "seawall", "jetty"}},
        {"aluminium", {"can", "coke"}},
        {"plastic", {"buoy", "fender", "marker"}}};
    return all;
}
const std::set<std::string> water_words{"water", "waves", "wave", "waterlow", "waterplane"};
const std::set<std::string> robot_words{"auv",     "rov",    "usv",   "uuv",      "asv",
                                        "bluerov", "rexrov", "wamv",  "desistek", "lauv",
                                        "glider",  "orca",   "robot", "eca",      "heron"};

/// Pieces of letters, small; a capital after a small letter begins a new one.
std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words(1);
    char before = ' ';
    for (const char c : text.substr(0, 256)) {
        const auto u = static_cast<unsigned char>(c);
        const bool begins = std::isupper(u) && std::islower(static_cast<unsigned char>(before));
        if ((!std::isalpha(u) || begins) && !words.back().empty()) words.emplace_back();
        if (std::isalpha(u)) words.back() += c;
        before = c;
    }
    std::erase(words, "");
    for (std::string& word : words) word = lower_case(word);
    return words;
}

/// What has a name, in the order in which it is asked.
struct Named {
    const char* what;
    const std::string* name;
};
std::vector<Named> names_of(const Clues& clues) {
    return {{"script", &clues.script}, {"surface", &clues.surface}, {"visual", &clues.visual},
            {"link", &clues.link},     {"mesh", &clues.mesh},       {"model", &clues.model}};
}

std::string quoted(const Named& named) {
    return std::string(named.what) + " \"" + printable(*named.name, 60) + "\"";
}

/// The reader's own name of what it finds in a text.
std::optional<std::string> acoustic_in(const std::string& text) {
    const auto surface = surface_by_name(text);
    if (!surface) return std::nullopt;
    for (const std::string& name : known_materials()) {
        const auto known = surface_by_name(name);
        if (known->mu_db == surface->mu_db && known->roughness == surface->roughness) return name;
    }
    return std::nullopt;
}

Choice named(const std::string& acoustic, std::string from, bool guessed) {
    return {{.name = acoustic, .acoustic = acoustic}, std::move(from), guessed, false};
}

std::optional<Choice> by_property(const Clues& clues) {
    if (clues.property.empty()) return std::nullopt;
    const auto acoustic = acoustic_in(clues.property);
    if (!acoustic) return std::nullopt;
    return named(*acoustic, "surface_props \"" + printable(clues.property, 60) + "\"", false);
}

std::optional<Choice> by_word(const Clues& clues) {
    for (const Named& name : names_of(clues))
        if (const auto acoustic = acoustic_in(*name.name)) return named(*acoustic, quoted(name), false);
    return std::nullopt;
}

std::optional<Choice> by_thing(const Clues& clues) {
    for (const Named& name : names_of(clues))
        for (const std::string& word : words_of(*name.name))
            for (const Thing& thing : things())
                if (thing.words.contains(word)) return named(thing.material, quoted(name), true);
    if (clues.terrain) return named("sand", "heightmap", true);
    return std::nullopt;
}

/// As an amplitude of reflection. Nothing says that it is one, and values above 1 are somebody's labels.
std::optional<Choice> by_laser_retro(const Clues& clues) {
    if (!clues.laser_retro || !(*clues.laser_retro > 0 && *clues.laser_retro <= 1)) return std::nullopt;
    const double v = std::max(0.01, *clues.laser_retro);
    const double least =
        std::sqrt(1 - v * v) < 1 ? 10 * std::log10(std::max(1e-12, (1 - v * v) / 3.1416)) : 0;
    // Lambert's constant as the table of materials has it, below what is left beside the mirrored part.
    const double mu_db =
        std::min(default_mu_db + 20 * std::log10(v / surface_by_name("sand")->reflection), least);
    Choice out;
    char text[64];
    std::snprintf(text, sizeof text, "laser_retro %.2f", v);
    out.material = {.name = text, .figures = {{"mu_db", std::max(mu_db, -119.0)}, {"reflection", v}}};
    out.from = text;
    out.guessed = true;
    return out;
}

}  // namespace

Choice choose_material(const Clues& clues, std::vector<MaterialRule>& rules) {
    if (const MaterialRule* rule = rule_for(clues, rules)) {
        Choice out{rule->material, "rule " + rule->place, false, rule->leave_out};
        out.material.name = !rule->material.acoustic.empty() ? rule->material.acoustic
                            : !rule->material.seabed.empty() ? rule->material.seabed
                                                             : "rule " + rule->place;
        return out;
    }
    for (auto* find : {by_property, by_word, by_thing, by_laser_retro})
        if (const auto choice = find(clues)) return *choice;
    return {{.name = "unknown"}, "nothing: -27 dB", true, false};
}

std::string sign_of_water(const Clues& clues) {
    const auto has = [](const std::string& name, const std::set<std::string>& words) {
        return std::ranges::any_of(words_of(name), [&](const auto& word) { return words.contains(word); });
    };
    const auto is_surface = [&](const std::string& name) {
        const auto words = words_of(name);
        for (std::size_t i = 0; i + 1 < words.size(); ++i)
            if ((words[i] == "sea" || words[i] == "ocean") && words[i + 1] == "surface") return true;
        return false;
    };
    for (const Named& name : names_of(clues))
        if (has(*name.name, water_words) || is_surface(*name.name)) return quoted(name);
    return {};
}

bool is_name_of_robot(const std::string& name) {
    return std::ranges::any_of(words_of(name), [](const auto& word) { return robot_words.contains(word); });
}

bool is_name_of_axes(const std::string& name) {
    return name == "axes" || name == "ned_frame" || name == "world_ned";
}

}  // namespace echoloop::worlds
