#include "tools/echoloop/conditions.h"

#include <algorithm>
#include <cmath>

#include "emulator/water/crosstalk.h"
#include "tools/echoloop/common.h"

namespace echoloop::cli {
namespace {

bool by_paper(const Scenario& scenario) { return scenario.render.rule == EchoRule::cerqueira2016; }

bool bends_rays(const Scenario& scenario) {
    return !by_paper(scenario) && scenario.render.effects.has(Effect::refraction);
}

/// Lowest and highest elevation in the world of a device's rays, rad, over a whole turn.
std::pair<double, double> elevations(const Scenario& scenario, const ScenarioDevice& device) {
    const Pose world_from_sonar = scenario.world_from_body * device.body_from_sonar;
    double low = 2, high = -2;
    for (std::size_t step = 0; step < device.model->turn_steps; ++step) {
        const Shot shot = device.model->default_shot(device.config, step, 0);
        for (const double bearing : shot.bearings)
            for (const double part : {-0.5, 0.0, 0.5}) {
                const double row = shot.rows() == 1 ? 0
                                   : part < 0       ? shot.elevations.front()
                                                    : shot.elevations.back();
                const double e = shot.tilt + row + part * shot.fan_height, b = shot.pan + bearing;
                const Vec3 ahead{std::cos(e) * std::cos(b), -std::cos(e) * std::sin(b), std::sin(e)};
                const double up = (world_from_sonar * ahead).z - world_from_sonar.position.z;
                const double elevation = std::asin(std::clamp(up, -1.0, 1.0));
                low = std::min(low, elevation);
                high = std::max(high, elevation);
            }
    }
    return {low, high};
}

std::string joined(const std::vector<std::string_view>& words) {
    std::string text;
    for (const auto word : words) text += (text.empty() ? "" : ", ") + std::string(word);
    return text;
}

std::string effects_text(const Scenario& scenario) {
    if (by_paper(scenario)) return "none; the rule cerqueira2016 has no effects";
    const auto off = effects_off(scenario);
    if (off.empty()) return "all on";
    return (off.size() == effect_rows.size() ? "all off" : "off: " + joined(off));
}

std::string ray_text(const RayBound& bound) {
    return bound.device + ": straight; an echo is shown at most " + plain(bound.error.displacement, 3) +
           " m from its true place (" + plain(rad_to_deg(bound.error.elevation), 1) + " deg up, " +
           plain(bound.error.range, 1) + " m; bound for ranges to " + plain(bound.range, 1) + " m)";
}

}  // namespace

std::vector<std::string_view> effects_off(const Scenario& scenario) {
    std::vector<std::string_view> off;
    for (const auto& row : effect_rows)
        if (by_paper(scenario) || !scenario.render.effects.has(row.effect)) off.push_back(row.name);
    return off;
}

std::vector<RayBound> ray_bounds(const Scenario& scenario) {
    std::vector<RayBound> bounds;
    if (scenario.water.profile.empty() || bends_rays(scenario)) return bounds;
    for (const auto& device : scenario.devices) {
        if (device.model->default_shot == nullptr) continue;  // no sonar
        const Shot shot = device.model->default_shot(device.config, 0, 0);
        const double end = shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval;
        const double speed = sound_speed(scenario.water), range = end * speed / 2;
        const auto [low, high] = elevations(scenario, device);
        bounds.push_back(
            {device.name, range,
             straight_ray_error(scenario.water.profile, speed, scenario.water.depth, range, low, high)});
    }
    return bounds;
}

namespace {

/// Pairs of sonars that stand in one place and hear each other's pulses, which the direct way weakens by
/// nothing.
std::vector<std::string> deafened(const Scenario& scenario) {
    constexpr double too_near = 0.1;    // m, own choice: about the width of a head
    constexpr double same_band = 0.01;  // of the energy of the pulse, own choice
    std::vector<std::string> all;
    if (by_paper(scenario) || !scenario.render.effects.has(Effect::cross_talk)) return all;
    const auto& devices = scenario.devices;
    for (std::size_t i = 0; i < devices.size(); ++i)
        for (std::size_t j = i + 1; j < devices.size(); ++j) {
            const auto is_sonar = [&](std::size_t k) { return devices[k].model->default_shot != nullptr; };
            if (!is_sonar(i) || !is_sonar(j)) continue;
            const double apart =
                norm(devices[i].body_from_sonar.position - devices[j].body_from_sonar.position);
            const auto shot = [&](std::size_t k) {
                return devices[k].model->default_shot(devices[k].config, 0, 0);
            };
            if (apart >= too_near || band_overlap(shot(i), shot(j)) < same_band) continue;
            all.push_back(devices[i].name + " and " + devices[j].name + ": " + plain(apart, 2) +
                          " m apart in the same band, so each hears the other's pulses instead of echoes; "
                          "give their mounts positions some decimetres apart, or switch the effect "
                          "cross_talk off");
        }
    return all;
}

}  // namespace

std::vector<std::string> warnings(const Scenario& scenario) {
    std::vector<std::string> all = deafened(scenario);
    if (!scenario.water.profile.empty() && scenario.water.sound_speed && bends_rays(scenario))
        all.emplace_back(
            "water.sound_speed times no echo, since rays bend by water.profile; leave it out, or switch the "
            "effect refraction off");
    if (by_paper(scenario) || !scenario.render.effects.has(Effect::absorption)) return all;
    for (const auto& device : scenario.devices) {
        if (device.model->default_shot == nullptr) continue;  // no sonar
        const double frequency = device.model->default_shot(device.config, 0, 0).frequency;
        if (absorption_is_extrapolated(frequency))
            all.push_back(device.name + ": absorption at " + plain(frequency / 1e3, 1) +
                          " kHz is extrapolated; Francois & Garrison fitted data up to 1 MHz");
    }
    return all;
}

std::string clock_text(const Scenario& scenario) {
    if (scenario.clock == ClockMode::real) return "real";
    if (scenario.clock == ClockMode::scaled)
        return "scaled: " + plain(scenario.clock_rate, 3) + " s of the run in one real second";
    if (scenario.clock == ClockMode::free)
        return "free: as fast as this machine renders; the scenario's own drivers speak, and no port is open";
    return "stepped: time stands still until a simulator sends {\"now\": SECONDS} to " +
           (scenario.step_input.empty() ? scenario.pose_input : scenario.step_input);
}

std::vector<Condition> conditions(const Scenario& scenario) {
    std::vector<Condition> lines;
    if (scenario.clock != ClockMode::real) lines.push_back({"clock", clock_text(scenario)});
    lines.push_back({"effects", effects_text(scenario)});
    for (const auto& bound : ray_bounds(scenario)) lines.push_back({"rays", ray_text(bound)});
    for (const auto& warning : warnings(scenario)) lines.push_back({"warning", warning});
    return lines;
}

}  // namespace echoloop::cli
