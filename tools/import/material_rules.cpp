#include "tools/import/material_rules.h"

#include <yaml-cpp/yaml.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

#include "render/scene/document_parts.h"
#include "render/scene/fault.h"
#include "render/scene/materials.h"
#include "tools/import/fault.h"

namespace echoloop::worlds {
namespace {

struct Condition {
    const char* key;
    std::string Clues::*of;
};
constexpr std::array conditions{Condition{"model", &Clues::model},   Condition{"link", &Clues::link},
                                Condition{"visual", &Clues::visual}, Condition{"script", &Clues::script},
                                Condition{"mesh", &Clues::mesh},     Condition{"surface", &Clues::surface}};
const std::vector<std::string> word_keys{"material", "seabed"};
const std::vector<std::string> number_keys{"mu_db", "reflection", "roughness", "slope", "patchiness_db"};

bool is_one_of(const std::vector<std::string>& list, const std::string& word) {
    return std::ranges::find(list, word) != list.end();
}

class RuleReader {
  public:
    RuleReader(const std::string& place, const YAML::Node& node) { rule_.place = place, read(node); }
    MaterialRule rule() && { return std::move(rule_); }

  private:
    [[noreturn]] void refuse(const std::string& why, const std::string& remedy) const {
        throw Fault(rule_.place, why, remedy);
    }

    void read(const YAML::Node& node) {
        if (!node.IsMap()) refuse("a rule is a map", "write for example {model: wreck, material: steel}");
        for (const auto& pair : node) read(pair.first.as<std::string>(), pair.second);
        if (rule_.conditions.empty())
            refuse("a rule without a condition", "say which of model, link, visual, script, mesh, surface");
        if (sonar_.empty() == !rule_.leave_out)
            refuse("a rule gives a material or leaves something out",
                   "write material: steel, or leave_out: true");
        check_material();
    }

    void read(const std::string& key, const YAML::Node& value) try {
        const auto condition =
            std::ranges::find_if(conditions, [&](const Condition& c) { return key == c.key; });
        if (condition != conditions.end())
            rule_.conditions.emplace_back(condition->of, std::regex(value.as<std::string>()));
        else if (is_one_of(word_keys, key))
            sonar_[key] = (key == "seabed" ? rule_.material.seabed : rule_.material.acoustic) =
                value.as<std::string>();
        else if (is_one_of(number_keys, key))
            rule_.material.figures.emplace_back(key, value.as<double>()), sonar_[key] = value.as<double>();
        else if (key == "leave_out")
            rule_.leave_out = value.as<bool>();
        else
            refuse_key(key);
    } catch (const std::regex_error&) {
        refuse(key + " is no regular expression", "put a backslash before characters such as ( and [");
    } catch (const YAML::Exception&) {
        refuse(key + " has a value of another kind", "see the examples in docs/import.md");
    }

    [[noreturn]] void refuse_key(const std::string& key) const {
        std::vector<std::string> known{"leave_out"};
        for (const Condition& condition : conditions) known.emplace_back(condition.key);
        known.insert(known.end(), word_keys.begin(), word_keys.end());
        known.insert(known.end(), number_keys.begin(), number_keys.end());
        const std::string near = nearest_of(key, known);
        std::string all;
        for (const std::string& word : known) all += (all.empty() ? "" : ", ") + word;
        refuse(printable(key, 64) + " is not a known key",
               near.empty() ? "known keys are " + all : "did you mean " + near + "?");
    }

    /// The scene's reader says what it would say of the finished scene.
    void check_material() const try {
        const nlohmann::json material{{"extras", {{"sonar", sonar_}}}};
        read_material(JsonView(material, "rule"));
    } catch (const SceneFault& fault) {
        refuse(fault.place.substr(fault.place.rfind('.') + 1) + ": " + fault.reason, fault.remedy);
    }

    MaterialRule rule_;
    nlohmann::json sonar_ = nlohmann::json::object();
};

}  // namespace

std::vector<MaterialRule> read_material_rules(const std::filesystem::path& file) {
    const std::string name = printable(file.string());
    std::vector<MaterialRule> rules;
    try {
        const YAML::Node root = YAML::LoadFile(file);
        if (!root.IsSequence())
            throw Fault(name, "is no list of rules",
                        "begin each with a dash: - {model: wreck, material: steel}");
        for (const YAML::Node& node : root)
            rules.push_back(RuleReader(name + ":" + std::to_string(node.Mark().line + 1), node).rule());
    } catch (const YAML::BadFile&) {
        throw Fault(name, "cannot be read", "name a file that exists");
    } catch (const YAML::ParserException& error) {
        throw Fault(name + ":" + std::to_string(error.mark.line + 1), "is no YAML: " + error.msg,
                    "see docs/import.md");
    }
    return rules;
}

MaterialRule* rule_for(const Clues& clues, std::vector<MaterialRule>& rules) {
    for (MaterialRule& rule : rules) {
        const bool fits = std::ranges::all_of(rule.conditions, [&](const auto& condition) {
            return std::regex_match((clues.*condition.first).substr(0, 256), condition.second);
        });
        if (!fits) continue;
        rule.used = true;
        return &rule;
    }
    return nullptr;
}

}  // namespace echoloop::worlds
