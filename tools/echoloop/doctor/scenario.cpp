#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "emulator/contract/error.h"
#include "emulator/run/runtime.h"
#include "emulator/water/render_threads.h"
#include "render/acoustics/receiver_noise.h"
#include "render/renderer.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/doctor/findings.h"

namespace echoloop::cli {
namespace {

using State = Finding::State;

Finding endpoints(const Scenario& scenario) {
    try {
        const Runtime runtime(scenario);
        return {State::good, "endpoints", "all can be opened; " + runtime.renderer(), ""};
    } catch (const std::exception& error) {
        return {State::bad, "endpoints", error.what(), "the message says what to do"};
    }
}

/// Median of several pings, s.
double time_of_ping(Renderer& renderer, const ScenarioDevice& device, const Pose& world_from_sonar) {
    constexpr std::size_t times = 9;
    std::vector<double> taken;
    for (std::size_t i = 0; i <= times; ++i) {
        const Shot shot = device.model->default_shot(device.config, 0, 0);
        const auto begin = std::chrono::steady_clock::now();
        renderer.render(shot, world_from_sonar);
        if (i > 0)
            taken.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    std::nth_element(taken.begin(), taken.begin() + times / 2, taken.end());
    return taken[times / 2];
}

Finding ping(Renderer& renderer, const ScenarioDevice& device, const Pose& world_from_sonar) {
    const Shot shot = device.model->default_shot(device.config, 0, 0);
    // A sonar of many rows shoots no faster than it says.
    const double window = shot.rows() > 1
                              ? shot.interval
                              : shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval;
    const double taken = time_of_ping(renderer, device, world_from_sonar);
    const std::string text = device.name + ": " + plain(taken * 1e3, 1) +
                             (shot.rows() > 1 ? " ms to render a ping; the sonar pings every "
                                              : " ms to render a ping; the sonar listens for ") +
                             plain(window * 1e3, 1) + " ms";
    if (taken > window)
        return {State::weak, "ping", text,
                "its pings will be late; use render: {pixels: 0.5}, a simpler scene or a longer range"};
    return {State::good, "ping", text, ""};
}

double db(double power) { return 10 * std::log10(power); }

/// Steps louder than the noise are a profile's fault: the head would show water as zeros.
Finding converter(const ScenarioDevice& device) {
    const Shot shot = device.model->default_shot(device.config, 0, 0);
    const double step = converter_step(shot), noise = received_noise(shot);
    if (step == 0) return {State::good, "converter", device.name + ": no steps", ""};
    const std::string text = device.name + ": the steps of its converter lie " +
                             plain(std::abs(db(step / noise)), 1) + " dB " +
                             (step > noise ? "above" : "below") + " a beam's noise";
    if (step > noise)
        return {State::weak, "converter", text,
                "give its profile more converter_bits or staves, or a lower saturation_level"};
    return {State::good, "converter", text, ""};
}

}  // namespace

Findings look_at_scenario(const Scenario& scenario) {
    Findings found{endpoints(scenario)};
    if (found.front().state == State::bad) return found;
    RendererOptions options = scenario.render;
    options.drawing_threads = RenderThreads::drawing_threads(scenario.devices.size());
    Renderer renderer(scene_of(scenario), scenario.water, options);
    const auto is_sonar = [](const ScenarioDevice& device) { return device.model->default_shot != nullptr; };
    for (const ScenarioDevice& device : scenario.devices)
        if (is_sonar(device)) found.push_back(converter(device));
    for (const ScenarioDevice& device : scenario.devices)
        if (is_sonar(device))
            found.push_back(ping(renderer, device, scenario.world_from_body * device.body_from_sonar));
    return found;
}

}  // namespace echoloop::cli
