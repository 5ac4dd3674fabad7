#include "emulator/scenario/clock_section.h"

#include "emulator/scenario/objects_section.h"

namespace echoloop::scenario {
namespace {

constexpr double start_of_stepped_runs = 1767225600;  // 2026-01-01T00:00:00Z
constexpr Range unix_times{0, 4102444800, "s since 1970"};

/// A key that only another mode understands.
void refuse(const Section& clock, std::string_view key, const std::string& mode, const std::string& other,
            Problems& problems) {
    if (const Value* value = clock.get(key))
        problems.add(value->key_place, clock.path_of(key) + " has no meaning in mode '" + mode +
                                           "'; add mode: " + other + ", or remove " + std::string(key));
}

void read_free(const Section& clock, Scenario& scenario, Problems& problems) {
    scenario.clock = ClockMode::free;
    if (!scenario.unix_start) scenario.unix_start = start_of_stepped_runs;
    if (clock.get("duration") != nullptr) scenario.duration = clock.number("duration", 0, {0.001, 1e7, "s"});
    if (!scenario.pose_input.empty())
        problems.add(
            clock.get("mode")->place,
            "clock.mode: in a 'free' run nobody is outside to send poses; give the vehicle a pose or a "
            "trajectory in place of vehicle.input, or choose mode: stepped");
    for (const ScenarioObject& object : scenario.objects)
        if (!object.input.empty())
            problems.add(clock.get("mode")->place,
                         "clock.mode: in a 'free' run nobody is outside to send poses of " + object.node +
                             "; give it a pose or a trajectory, or choose mode: stepped");
}

void read_steps(const Section& clock, Scenario& scenario, Problems& problems) {
    scenario.step_input = read_pose_endpoint(clock, "input", problems);
    if (!scenario.unix_start) scenario.unix_start = start_of_stepped_runs;
    if (clock.get("input") == nullptr && scenario.pose_input.empty())
        problems.add(clock.get("mode")->place,
                     "clock.mode: 'stepped' needs an endpoint for the steps; add e.g. input: "
                     "tcp-listen://127.0.0.1:9501, or vehicle.input");
}

}  // namespace

void read_clock(const Section& top, Scenario& scenario, Problems& problems) {
    const Section clock(top.get("clock"), "clock", {"mode", "rate", "input", "unix_start", "duration"},
                        problems);
    const auto mode = clock.word("mode", "real", {"real", "scaled", "stepped", "free"});
    if (clock.get("unix_start") != nullptr) scenario.unix_start = clock.number("unix_start", 0, unix_times);
    scenario.clock_rate = clock.number("rate", 1, {0.001, 1000, ""});
    if (mode != "scaled") refuse(clock, "rate", mode, "scaled", problems);
    if (mode != "stepped") refuse(clock, "input", mode, "stepped", problems);
    if (mode != "free") refuse(clock, "duration", mode, "free", problems);
    if (mode == "free") read_free(clock, scenario, problems);
    if (mode == "scaled") {
        scenario.clock = ClockMode::scaled;
        if (clock.get("rate") == nullptr)
            problems.add(clock.get("mode")->place, "clock.mode: 'scaled' needs a rate; add e.g. rate: 5");
    }
    if (mode == "stepped") {
        scenario.clock = ClockMode::stepped;
        read_steps(clock, scenario, problems);
    }
}

}  // namespace echoloop::scenario
