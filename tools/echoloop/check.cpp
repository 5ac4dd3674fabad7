// echoloop check: would this scenario run? Loads scenario and scene, opens no port and draws nothing.
#include <cstdio>

#include "emulator/pose/movers.h"
#include "emulator/scenario/scene.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/conditions.h"
#include "tools/echoloop/declared_materials.h"
#include "tools/echoloop/driver_port.h"
#include "tools/echoloop/json_output.h"
#include "tools/echoloop/time_budget.h"

namespace echoloop::cli {
namespace {

std::string extent(const Bounds& b) {
    static constexpr const char* axes[] = {"x ", ", y ", ", z "};
    std::string text;
    for (std::size_t i = 0; i < 3; ++i) text += axes[i] + plain(b.min[i], 1) + " to " + plain(b.max[i], 1);
    return text + " m";
}

std::string water_line(const Water& w) {
    return plain(w.temperature, 1) + " degC, salinity " + plain(w.salinity, 1) + " g/kg, pH " +
           plain(w.ph, 1) + ", depth " + plain(w.depth, 1) + " m, sound speed " + plain(sound_speed(w), 1) +
           " m/s" +
           (w.sound_speed       ? ""
            : w.profile.empty() ? " (Mackenzie 1981)"
                                : " (profile)");
}

std::string moved_by(const Scenario& scenario, const SceneMover& mover) {
    for (const auto& object : scenario.objects) {
        if (object.node != mover.name) continue;
        if (!object.trajectory.empty()) return "moves by " + object.trajectory.string();
        if (!object.input.empty()) return "takes poses from " + object.input;
        if (object.pose) return "is placed by the scenario";
        return "takes poses from the lines of vehicle.input that name it";
    }
    return "is moved by the scene's animation";
}

void print_scene(const Scenario& scenario, const Scene& scene) {
    std::printf("%s%s\n", padded("scene", 12).c_str(), scenario.scene.c_str());
    std::printf("%s%s, %s, %s\n", padded("", 12).c_str(), counted(scene.triangles(), "triangle").c_str(),
                counted(scene.objects().size(), "object").c_str(), extent(scene.bounds()).c_str());
    for (const auto& material : declared_materials(scene))
        std::printf("%s%s scatters %s dB%s\n", padded("material", 12).c_str(),
                    padded(material.name, 20).c_str(), plain(material.mu_db, 2).c_str(),
                    material.double_sided ? ", both sides" : "");
    for (const auto& mover : scene.movers())
        std::printf("%s%s %s\n", padded("mover", 12).c_str(), mover.name.c_str(),
                    moved_by(scenario, mover).c_str());
    for (const auto& note : scene.notes()) std::printf("%s%s\n", padded("note", 12).c_str(), note.c_str());
}

void print_devices(const Scenario& scenario) {
    for (const auto& device : scenario.devices) {
        std::string endpoints;
        for (const auto& end : device.config.endpoints)
            endpoints += "  " + (end.listens() && end.port == 0 ? std::string(scheme_name(end.scheme)) +
                                                                      "://" + address_text(end.host, 0)
                                                                : to_string(end));
        std::printf("%s%s%s%s\n", padded("device", 12).c_str(), padded(device.name, 16).c_str(),
                    padded(device.model->name, 18).c_str(), endpoints.c_str());
        const bool pings = device.model->default_shot != nullptr;
        std::printf("%s%s\n", padded("", 12).c_str(),
                    pings ? text_of(time_budget(device)).c_str() : "it is no sonar and sends no pings");
    }
}

int run_check(const Arguments& arguments) {
    try {
        Scenario scenario = scenario_from(arguments);
        const auto scene = scene_of(scenario);
        scenario.origin = origin_of(scenario, *scene);
        Movers(scenario, scene);  // reads what moves them
        if (arguments.has("--json")) {
            std::printf("%s\n", check_json(scenario, *scene).c_str());
            return 0;
        }
        std::printf("%s%s: good\n", padded("scenario", 12).c_str(), scenario.file.c_str());
        print_scene(scenario, *scene);
        if (const auto& origin = scenario.origin)
            std::printf("%slatitude %s, longitude %s deg, height %s m\n", padded("origin", 12).c_str(),
                        plain(origin->latitude, 7).c_str(), plain(origin->longitude, 7).c_str(),
                        plain(origin->height, 2).c_str());
        std::printf("%s%s\n", padded("water", 12).c_str(), water_line(scenario.water).c_str());
        for (const auto& [name, text] : conditions(scenario))
            std::printf("%s%s\n", padded(name, 12).c_str(), text.c_str());
        print_devices(scenario);
    } catch (const ScenarioError& error) {
        if (arguments.has("--json")) std::printf("%s\n", problems_json(error.problems()).c_str());
        throw;
    } catch (const StartError& error) {
        if (arguments.has("--json"))
            std::printf("%s\n", problems_json({{Problem::Kind::invalid, "", 0, 0, error.what()}}).c_str());
        throw;
    }
    return 0;
}

}  // namespace

Verb check_verb() {
    return {"check",
            "check whether a scenario would run, and show what is in it",
            {scenario_argument(), set_argument(), json_argument()},
            "  echoloop check demo\n"
            "  echoloop check demo --set water.temperature=4\n"
            "  echoloop check demo --json | jq .scene.triangles",
            run_check};
}

}  // namespace echoloop::cli
