// echoloop run: the emulator, until a signal or the end of the time.
#include <cstdio>
#include <optional>

#include "emulator/runtime.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/conditions.h"
#include "tools/echoloop/driver.h"
#include "tools/echoloop/json_run.h"

namespace echoloop::cli {
namespace {

void print_start(const Scenario& scenario, const Runtime& runtime) {
    std::printf("echoloop %s: %s, %zu triangles, %s\n", ECHOLOOP_VERSION, scenario.scene.c_str(),
                runtime.triangles(), runtime.renderer().c_str());
    for (const auto& [name, text] : conditions(scenario))
        std::printf("%s%s\n", padded(name, 16).c_str(), text.c_str());
    for (const auto& device : scenario.devices) {
        std::printf("%s%s\n", padded(device.name, 16).c_str(), device.model->title.c_str());
        for (const auto& place : wire_places(device))
            std::printf("  %s%s\n", padded(place.what, 30).c_str(), place.address.c_str());
    }
    std::printf(
        "running; Ctrl-C ends it. For a driver: echoloop endpoints %s --format ros1 (or ros2, moos, rock)\n",
        scenario.file.c_str());
    std::fflush(stdout);
}

void print_summary(const std::vector<SessionSummary>& sessions) {
    for (const auto& s : sessions) {
        std::printf(
            "%s%llu pings, %llu late (worst %s ms), %llu messages, %llu rejected, %llu bytes skipped, "
            "%llu dropped, %llu bytes in, %llu out\n",
            padded(s.name, 16).c_str(), static_cast<unsigned long long>(s.pings),
            static_cast<unsigned long long>(s.late_pings),
            plain(to_seconds(s.worst_lateness) * 1e3, 1).c_str(),
            static_cast<unsigned long long>(s.device.messages),
            static_cast<unsigned long long>(s.device.rejected),
            static_cast<unsigned long long>(s.device.skipped_bytes),
            static_cast<unsigned long long>(s.dropped), static_cast<unsigned long long>(s.bytes_in),
            static_cast<unsigned long long>(s.bytes_out));
    }
}

int run(const Arguments& arguments) {
    const Scenario scenario = scenario_from(arguments);
    std::optional<double> duration;
    if (arguments.has("--duration")) duration = arguments.number("--duration", 0, 0, 1e9);
    try {
        Runtime runtime(scenario);
        const bool json = arguments.has("--json");
        if (json) {
            std::printf("%s\n", run_started_json(scenario, runtime).c_str());
            std::fflush(stdout);
        } else {
            print_start(scenario, runtime);
        }
        runtime.run(duration);
        if (json) {
            std::printf("%s\n", run_summary_json(runtime.summary()).c_str());
        } else {
            print_summary(runtime.summary());
        }
    } catch (const StartError&) {
        throw;
    } catch (const SceneError& error) {
        throw StartError(Exit::data, error.what());
    } catch (const std::invalid_argument& error) {
        throw StartError(Exit::config, error.what());
    } catch (const std::runtime_error& error) {
        throw StartError(Exit::unavailable, error.what());
    }
    return 0;
}

}  // namespace

Verb run_verb() {
    return {
        "run",
        "start the emulator",
        {scenario_argument(),
         {Argument::Kind::value, "--duration", "SECONDS",
          "end after this time; without it: run until Ctrl-C"},
         set_argument(),
         {Argument::Kind::flag, "--json", "", "print one JSON line at the start and one at the end"}},
        "  echoloop run config/demo.yaml\n"
        "  echoloop run config/tank.yaml --duration 60\n"
        "  echoloop run config/demo.yaml --set devices.micron.endpoints='[\"tcp-listen://127.0.0.1:9090\"]'",
        run};
}

}  // namespace echoloop::cli
