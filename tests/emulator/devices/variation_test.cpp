// No model says the same for ever: what its sensors read and when its pings come differs from unit to unit
// and from moment to moment, is the same in each run, and stands still without the effects.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <set>

#include "protocols/inspect.h"
#include "tests/emulator/devices/cerulean_bench.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;

/// These ping when their host says so, and have no sensors beside the transducer.
const std::set<std::string> without{"imagenex-852",   "imagenex-872",     "imagenex-881a",  "ping360",
                                    "tritech-micron", "tritech-profiler", "tritech-seaking"};

DeviceConfig unit(const Model& model, std::uint64_t key, bool varies) {
    DeviceConfig config = make_config(model);
    config.random_key = key;
    config.effects.set(Effect::sensor_noise, varies).set(Effect::ping_jitter, varies);
    if (model.name == "norbit-wbms") config.options.at("power") = true;
    if (model.name == "edgetech-2205") config.options.at("start") = std::string("both");
    if (model.name == "nortek-nucleus") config.options.at("starts_at_once") = true;
    if (model.name == "sonar-3d-15") config.options.at("acoustics") = true;
    return config;
}

/// What starts the pings of those whose hosts have a longer talk.
std::vector<Bytes> first_words(const Model& model, const DeviceConfig& config) {
    if (model.name == "omniscan450") return {frame(OmniscanParams{})};
    if (model.name == "s500") return {frame(S500Params{})};
    if (model.name == "surveyor240") return {frame(Set{})};
    return model.requests != nullptr ? model.requests(config, 2, false) : std::vector<Bytes>{};
}

/// All that it says within 3 s, and when its pings are due; hosts say what a plain driver says.
std::vector<std::string> life_of(const Model& model, const DeviceConfig& config) {
    Bench bench(model.make(config));
    const auto ports = bench.device().ports();
    for (std::size_t port = 0; port < ports.size(); ++port)
        if (ports[port].kind == Port::Kind::stream)
            bench.device().reconnected(port), bench.connect(port, host);
    for (const Bytes& words : first_words(model, config)) bench.say(words, 0, host);
    std::vector<std::string> life;
    std::optional<Time> due;
    for (Time now{}; now < 3s; now += 5ms) {
        bench.run_to(now);
        for (const Send& send : bench.sent()) life.push_back(to_hex(send.bytes));
        if (bench.ping && bench.ping->due != due)
            life.push_back(std::to_string((due = bench.ping->due)->count()));
    }
    return life;
}

class Variation : public testing::TestWithParam<std::string> {};

TEST_P(Variation, IsOfTheUnitAndTheSameInEachRun) {
    const Model& model = *find_model(GetParam());
    const auto life = life_of(model, unit(model, 7, true));
    EXPECT_EQ(life, life_of(model, unit(model, 7, true)));
    const bool varies = life != life_of(model, unit(model, 8, true));
    EXPECT_EQ(varies, !without.contains(model.name));
    EXPECT_EQ(life_of(model, unit(model, 7, false)), life_of(model, unit(model, 8, false)));
}

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const Model& model : models()) all.push_back(model.name);
    return all;
}
INSTANTIATE_TEST_SUITE_P(All, Variation, testing::ValuesIn(names()), [](const auto& model) {
    std::string name = model.param;
    for (char& c : name)
        if (c == '-') c = '_';
    return name;
});

/// The sound speeds that it tells within 1.9 s, while the true one rises with every ping, as where a boat
/// heaves.
std::vector<double> told_speeds(const std::string& name, const std::string& field, bool varies) {
    const Model& model = *find_model(name);
    Bench bench(model.make(unit(model, 7, varies)));
    const auto ports = bench.device().ports();
    for (std::size_t port = 0; port < ports.size(); ++port)
        if (ports[port].kind == Port::Kind::stream) bench.connect(port, host);
    std::vector<double> told;
    for (double speed = 1480; bench.now < 1900ms; speed += 0.3) {
        while (!bench.ping) bench.run_to(std::max(bench.wake, bench.now + 1us));
        Echogram echo = echo_of(bench.ping->shot, 300, 1e14F);
        echo.sound_speed = speed;
        bench.hear(echo);
        for (const Send& send : bench.sent())
            for (const auto& message : inspect::find_family(model.family)->decode(send.bytes))
                for (const auto& one : message.fields)
                    if (one.name == field) told.push_back(*one.number);
    }
    return told;
}

TEST(Variation, AProbeTellsItsLastValueUntilItMeasuresAgain) {
    for (const auto& [name, field] :
         {std::pair{"kongsberg-kmall", "ping.sound_speed"}, std::pair{"r2sonic-2026", "h0.sound_speed"}}) {
        const auto told = told_speeds(name, field, true), exact = told_speeds(name, field, false);
        ASSERT_GT(exact.size(), 10U) << name;
        const std::set<double> values(told.begin(), told.end()), all(exact.begin(), exact.end());
        EXPECT_GE(values.size(), 2U) << name;
        EXPECT_LE(values.size(), 6U) << name << ": 1 Hz or 2 Hz, and a ping before the first";
        EXPECT_GE(all.size() + 1, exact.size()) << name << ": each ping its own";
    }
}

/// Temperatures of the status, degC, at bytes 70 to 133: eight converters of their own.
TEST(Variation, EachThermometerOfAnOculusDrifts) {
    const Model& model = *find_model("oculus-m750d");
    Bench bench(model.make(unit(model, 7, true)));
    std::array<std::set<double>, 8> read;
    for (int second = 0; second < 120; ++second) {
        bench.run_to(second * 1s);
        for (const Send& send : bench.sent()) {
            if (send.bytes.size() < 142) continue;
            for (std::size_t i = 0; i < read.size(); ++i) {
                double value = 0;
                std::memcpy(&value, send.bytes.data() + 70 + 8 * i, sizeof value);
                read[i].insert(value);
            }
        }
    }
    for (const auto& values : read) {
        EXPECT_GE(values.size(), 3U);
        EXPECT_GT(*values.begin(), 5) << "10 degC, give or take the drift";
        EXPECT_LT(*values.rbegin(), 15);
    }
}

}  // namespace
}  // namespace echoloop::test
