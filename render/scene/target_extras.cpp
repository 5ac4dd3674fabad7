#include <cmath>

#include "render/scene/document_parts.h"
#include "render/scene/fault.h"
#include "render/scene/limits.h"
#include "render/scene/materials.h"

namespace echoloop {
namespace {

constexpr const char* strength_key = "target_strength_db";
constexpr const char* example = "write for example {\"target_strength_db\": -20}";

void check_target_keys(const JsonView& sonar) {
    if (!sonar.value().is_object()) scene_fault(sonar.place(), "must be an object", example);
    for (const auto& [key, value] : sonar.value().items()) {
        if (key == strength_key) continue;
        const bool near = !nearest_of(key, {strength_key}).empty();
        scene_fault(sonar.place() + "." + key.substr(0, 64), "is not a known key of a node",
                    near ? std::string("did you mean ") + strength_key + "?"
                         : std::string("the known key is ") + strength_key + "; materials have others");
    }
}

}  // namespace

std::optional<double> read_target_strength(const JsonView& node) {
    const auto extras = node.find("extras");
    if (!extras || !extras->value().is_object()) return std::nullopt;
    const auto sonar = extras->find("sonar");
    if (!sonar) return std::nullopt;
    check_target_keys(*sonar);
    const auto strength = sonar->find(strength_key);
    if (!strength) return std::nullopt;
    const double db = strength->number();
    if (!(std::abs(db) <= scene_limits::target_strength_db))
        scene_fault(strength->place(), "must be within +-120 dB",
                    "give the target strength, for example -20");
    return db;
}

}  // namespace echoloop
