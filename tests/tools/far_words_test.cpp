// Water without an echo, as it stands on the wire: noise has many values there, whatever the gain makes of
// it. A device that rounds before its gain, or codes too coarsely, would leave three or four. Steps of the
// converter come as noise (render/acoustics); that they lie below a beam's noise is held by floor_test.cpp.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/render/meshes.h"
#include "tests/tools/wire_words.h"

namespace echoloop::test {
namespace {

/// Nothing but the receiver's noise, as loud at every range: the far field of any window.
const std::vector<std::string> noise_alone{"effects.tvg=off", "effects.ring_down=off",
                                           "effects.interference=off", "effects.reverberation=off"};

/// How many of the numbers of 16 bits, with or without a sign, are among them.
std::size_t distinct(const std::vector<double>& values) {
    constexpr std::size_t most = 0x10000;
    std::vector<bool> there(2 * most);
    for (const double value : values) there[static_cast<std::size_t>(value + most)] = true;
    return static_cast<std::size_t>(std::ranges::count(there, true));
}

/// What the wire itself leaves of it, where it is less than 60: steps of half a dB, of which the peak of five
/// looks spans some 16 dB.
std::size_t least(const Model& model) { return model.name.starts_with("tritech-") ? 35 : 60; }

/// The most values that a field of levels has at any gain, by message and field; gains are tried until all
/// have enough.
std::map<std::string, std::size_t> most_values(const Scenario& scenario, const ScenarioDevice& device,
                                               Renderer& open_water, const WireCase* words) {
    const int pings = device.model->turn_steps > 1 || device.model->family == "ping" ? 8 : 1;
    std::map<std::string, std::size_t> most;
    std::map<std::string, std::vector<double>> before;
    for (const double gain : {50.0, 75.0, 25.0, 100.0, 0.0}) {
        std::vector<Send> sent;
        InScene(scenario, device, open_water, words, gain).run(pings, sent);
        std::map<std::string, std::vector<double>> heard;
        for (const auto& field : word_fields(*inspect::find_family(device.model->family), sent)) {
            auto& values = heard[field.name];
            values.insert(values.end(), field.numbers.begin(), field.numbers.end());
        }
        for (const auto& [name, values] : heard)
            if (before.contains(name) && values != before[name])  // else it holds no levels
                most[name] = std::max({most[name], distinct(values), distinct(before[name])});
        const bool first = before.empty();
        before = heard;
        const auto enough = [&](const auto& field) { return field.second >= least(*device.model); };
        if (!first && std::ranges::all_of(most, enough)) break;
    }
    return most;
}

TEST(FarWords, AreNoiseOfManyValues) {
    const std::vector<Mesh> nothing_near{
        quad("speck", {-5000, 0, 0}, {-5000, 0.01, 0}, {-5000, 0.01, 0.01}, {-5000, 0, 0.01})};
    std::set<std::string> asked, answered;
    for (const auto& entry : std::filesystem::directory_iterator(ECHOLOOP_SOURCE_DIR "/config")) {
        if (entry.path().extension() != ".yaml" || !shows_sonars(entry.path().stem())) continue;
        const Scenario scenario = load_scenario(entry.path(), noise_alone, models());
        const auto is_known = [&](const ScenarioDevice& device) {
            return !is_sonar(*device.model) || asked.contains(device.model->name);
        };
        if (std::ranges::all_of(scenario.devices, is_known)) continue;
        Renderer open_water(Scene::from_meshes(nothing_near, {}), scenario.water, scenario.render);
        for (const ScenarioDevice& device : scenario.devices) {
            if (!is_sonar(*device.model) || !asked.insert(device.model->name).second) continue;
            each_way_to_ask(device, [&](const WireCase* words) {
                for (const auto& [name, values] : most_values(scenario, device, open_water, words)) {
                    const std::string what = device.model->name + " " + name;
                    std::printf("%-60s %5zu values\n", what.c_str(), values);
                    EXPECT_GE(values, least(*device.model)) << what;
                    answered.insert(device.model->name);
                }
            });
        }
    }
    EXPECT_GE(answered.size(), 18U) << "all that send samples";
}

}  // namespace
}  // namespace echoloop::test
