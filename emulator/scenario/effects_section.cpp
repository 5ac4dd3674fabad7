#include "emulator/scenario/effects_section.h"

namespace echoloop::scenario {
namespace {

/// on, off, true or false; another value is a problem and changes nothing.
void read_switch(const Value& value, const std::string& path, bool& on, Problems& problems) {
    const bool plain = value.is_scalar() && !value.quoted;
    if (plain && (value.text == "on" || value.text == "true")) {
        on = true;
    } else if (plain && (value.text == "off" || value.text == "false")) {
        on = false;
    } else {
        problems.add(value.place, path + ": expected on or off, got " + describe(value));
    }
}

/// speckle: {shape: 4} is on, with a K distribution.
void read_shape(const Value& value, const std::string& path, RendererOptions& options, Problems& problems) {
    const Section section(&value, path, {"shape"}, problems);
    options.speckle.shape = section.number("shape", options.speckle.shape, {0.1, 1e6, ""});
    options.effects.set(Effect::speckle);
}

}  // namespace

void read_effects(const Value* value, RendererOptions& options, Problems& problems) {
    if (value != nullptr && value->is_scalar()) {
        problems.add(value->place, "effects: expected names and on or off, got " + describe(*value) +
                                       "; to switch all off write effects: {all: off}");
        return;
    }
    std::vector<std::string_view> known{"all"};
    for (const auto& row : effect_rows) known.push_back(row.name);
    const Section section(value, "effects", known, problems);
    if (const Value* all = section.get("all")) {
        bool on = true;
        read_switch(*all, section.path_of("all"), on, problems);
        if (!on) options.effects = Effects::none();
    }
    for (const auto& row : effect_rows) {
        const Value* given = section.get(row.name);
        if (given == nullptr) continue;
        if (row.effect == Effect::speckle && given->is_map()) {
            read_shape(*given, section.path_of(row.name), options, problems);
            continue;
        }
        bool on = options.effects.has(row.effect);
        read_switch(*given, section.path_of(row.name), on, problems);
        options.effects.set(row.effect, on);
    }
}

}  // namespace echoloop::scenario
