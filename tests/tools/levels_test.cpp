// No model uses less than a third of its words' dynamic range, or sits pinned at an end, in any demo scene: a
// default reference that was never held against anything shows here. Words are all arrays of whole numbers of
// 8 or 16 bits in a model's messages that change when the water gets louder; which messages there are, the
// scenarios in config/ and the cases of `echoloop bench --wire` say.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/tools/wire_words.h"

namespace echoloop::test {
namespace {

/// Words of the same field that are not the same.
std::size_t differences(const inspect::Field& a, const inspect::Field& b) {
    if (a.name != b.name || a.numbers.size() != b.numbers.size()) return 0;
    std::size_t count = 0;
    for (std::size_t n = 0; n < a.numbers.size(); ++n) count += a.numbers[n] != b.numbers[n];
    return count;
}

/// Adds the words of one run; those are words that change in quieter or louder water.
void listen(const Scenario& scenario, const ScenarioDevice& device, Renderer& renderer, const WireCase* words,
            Report& report) {
    const auto& family = *inspect::find_family(device.model->family);
    std::vector<Send> sent;
    const int pings = device.model->turn_steps > 1 ? 8 : 2;
    const std::string who = device.model->name + (words != nullptr ? " (" + words->name + ")" : "");
    ASSERT_TRUE(InScene(scenario, device, renderer, words, 0).run(pings, sent))
        << who
        << " does not ping; give its model `requests`, or a case in tools/echoloop/bench/wire_cases.cpp";
    const auto fields = word_fields(family, sent);
    std::vector<std::size_t> changed(fields.size());
    for (const double gain : {-40.0, 40.0}) {
        InScene(scenario, device, renderer, words, gain).run(pings, sent);
        const auto other = word_fields(family, sent);
        for (std::size_t i = 0; i < std::min(fields.size(), other.size()); ++i)
            changed[i] = std::max(changed[i], differences(fields[i], other[i]));
    }
    const auto add = [&](const auto& of) {
        for (std::size_t i = 0; i < std::min(of.size(), changed.size()); ++i) {
            const auto& numbers = of[i].numbers;
            Words& known = report[who + " " + of[i].name];
            known.values.insert(known.values.end(), numbers.begin(), numbers.end());
            const bool wide = of[i].size == 2 * numbers.size() || *std::ranges::max_element(numbers) > 255;
            known.bytes = std::max<std::size_t>(known.bytes, wide ? 2 : 1);
            known.changed += changed[i];
        }
    };
    add(fields);
    // A sonar at rest keeps its speckle, and one of a few words has few loud ones: they are those of several.
    constexpr std::size_t few = 4000;
    std::size_t all = 0;
    for (const auto& field : fields) all += field.numbers.size();
    Scenario other = scenario;
    for (int unit = 1; unit < 4 && all < few; ++unit) {
        ++other.seed;
        InScene(other, device, renderer, words, 0).run(pings, sent);
        add(word_fields(family, sent));
    }
}

/// What all devices of a scene send.
Report heard_in(const std::filesystem::path& file) {
    const Scenario scenario = load_scenario(file, {}, models());
    const auto scene = load_scene(scenario);
    Renderer renderer(scene, scenario.water, scenario.render);
    Report report;
    for (const ScenarioDevice& device : scenario.devices)
        if (is_sonar(*device.model))
            each_way_to_ask(
                device, [&](const WireCase* words) { listen(scenario, device, renderer, words, report); });
    return report;
}

TEST(Levels, UseAThirdOfTheScaleAndAreNotPinnedInTheDemo) {
    std::string seen;
    for (const auto& entry : std::filesystem::directory_iterator(ECHOLOOP_SOURCE_DIR "/config")) {
        const std::string scenario = entry.path().stem();
        if (entry.path().extension() != ".yaml" || !shows_sonars(scenario)) continue;
        for (const ScenarioDevice& device : load_scenario(entry.path(), {}, models()).devices)
            seen += device.model->name + "\n";
        for (const auto& [name, words] : heard_in(entry.path())) {
            if (words.changed * 20 < words.values.size()) continue;  // no words of levels
            const std::string what = scenario + ": " + name;
            const double low = words.part(words.lowest()), high = words.part(words.highest());
            std::printf("%-80s used %3.0f %%, lowest %5.1f %%, highest %5.2f %%\n", what.c_str(),
                        100 * words.used(), 100 * low, 100 * high);
            EXPECT_GE(words.used(), 1.0 / 3) << what;
            EXPECT_LE(low, 0.98) << what << ": pinned below; water without an echo may read 0, not all";
            EXPECT_LE(high, 0.1) << what << ": pinned above";
        }
    }
    for (const Model& model : models())
        EXPECT_NE(seen.find(model.name + "\n"), seen.npos) << model.name << " has no scenario in config/";
}

}  // namespace
}  // namespace echoloop::test
