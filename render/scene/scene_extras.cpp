#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/scene/document_parts.h"
#include "render/scene/fault.h"
#include "render/scene/materials.h"

namespace echoloop {
namespace {

constexpr const char* origin_example =
    "write for example {\"origin\": {\"latitude\": 59.4, \"longitude\": 10.5, \"height\": 0}}";

void check_keys(const JsonView& object, const std::vector<std::string>& known) {
    if (!object.value().is_object()) scene_fault(object.place(), "must be an object", origin_example);
    for (const auto& [key, value] : object.value().items()) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        const std::string nearest = nearest_of(key, known);
        scene_fault(object.place() + "." + key.substr(0, 64), "is not a known key of a scene",
                    nearest.empty() ? std::string(origin_example) : "did you mean " + nearest + "?");
    }
}

double number_within(const JsonView& origin, const char* key, double most, double fallback) {
    const auto value = origin.find(key);
    if (!value) return fallback;
    const double number = value->number();
    if (!(std::abs(number) <= most))
        scene_fault(value->place(), "must be within +-" + std::to_string(static_cast<int>(most)),
                    origin_example);
    return number;
}

}  // namespace

std::optional<GeoPlace> read_origin(const JsonView& scene) {
    const auto extras = scene.find("extras");
    if (!extras || !extras->value().is_object()) return std::nullopt;
    const auto sonar = extras->find("sonar");
    if (!sonar) return std::nullopt;
    check_keys(*sonar, {"origin"});
    const auto origin = sonar->find("origin");
    if (!origin) return std::nullopt;
    check_keys(*origin, {"latitude", "longitude", "height"});
    origin->need("latitude"), origin->need("longitude");
    return GeoPlace{number_within(*origin, "latitude", geographic::steepest, 0),
                    number_within(*origin, "longitude", 180, 0),
                    number_within(*origin, "height", geographic::highest, 0)};
}

}  // namespace echoloop
