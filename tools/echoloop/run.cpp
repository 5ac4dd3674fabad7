// echoloop run: the emulator, until a signal or the end of the time.
#include <cerrno>
#include <cstdio>
#include <optional>

#include "emulator/capture/recording.h"
#include "emulator/dataset/dataset.h"
#include "emulator/pose/input.h"
#include "emulator/pose/step_server.h"
#include "emulator/run/runtime.h"
#include "emulator/scenario/control_place.h"
#include "emulator/truth/truth.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/conditions.h"
#include "tools/echoloop/dataset_progress.h"
#include "tools/echoloop/driver.h"
#include "tools/echoloop/faults_output.h"
#include "tools/echoloop/json_run.h"
#include "tools/echoloop/live_view.h"
#include "tools/echoloop/run_summary.h"

namespace echoloop::cli {
namespace {

std::string driver_text(const ScenarioDevice& device) {
    if (device.script.empty()) return "no driver says anything to it";
    return "a driver of the scenario has " + counted(device.script.size(), "line") + " for it";
}

/// s, of real time or of the run; a free run has to end by itself.
std::optional<double> duration_of(const Arguments& arguments, const Scenario& scenario) {
    if (arguments.has("--duration")) return arguments.number("--duration", 0, 0, 1e9);
    if (scenario.clock == ClockMode::free && !scenario.duration)
        throw StartError(Exit::usage,
                         "a free run has to end by itself; give --duration SECONDS of the run, or add "
                         "clock.duration to the scenario");
    return scenario.duration;
}

void print_start(const Runtime& runtime, std::optional<double> duration, const std::string& view) {
    const Scenario& scenario = runtime.scenario();
    const auto line = [](const std::string& name, const std::string& text) {
        std::printf("%s%s\n", padded(name, 16).c_str(), text.c_str());
    };
    line("echoloop", ECHOLOOP_VERSION);
    line("scene", scenario.scene.string() + ", " + counted(runtime.triangles(), "triangle"));
    line("renderer", runtime.renderer());
    for (const auto& [name, text] : conditions(scenario)) line(name, text);
    if (!scenario.pose_input.empty()) line("vehicle", "takes poses from " + scenario.pose_input);
    if (!scenario.trajectory.empty()) line("vehicle", "moves by " + scenario.trajectory.string());
    for (const auto& device : scenario.devices) {
        line(device.name, device.model->title);
        if (scenario.clock == ClockMode::free)
            std::printf("  %s\n", driver_text(device).c_str());
        else
            for (const auto& place : wire_places(device)) std::printf("  %s\n", place_line(place).c_str());
    }
    for (const RunningDevice& device : runtime.devices())
        for (const std::string& networks : device.open_to)
            line(device.name,
                 "is open to " + networks +
                     (scenario.peers.empty() ? ", as its interface is; `peers` names others" : ""));
    if (const std::string token = runtime.control_token(); !token.empty())
        line("control", scenario.control + ", token " + token);
    else if (!scenario.control.empty())
        line("control", scenario.control);
    if (!view.empty()) line("view", view);
    if (scenario.clock != ClockMode::free)
        std::printf("For a driver: %s endpoints %s --format ros1 (or ros2, moos, rock, sitl)\n",
                    program_invocation_name, scenario.file.c_str());
    const bool stepped = scenario.clock == ClockMode::stepped || scenario.clock == ClockMode::free;
    const std::string end =
        duration ? " for " + plain(*duration, 1) + (stepped ? " s of the run" : " s") : "";
    std::printf("running%s; Ctrl-C ends it\n", end.c_str());
    std::fflush(stdout);
}

/// nullptr without --record.
std::unique_ptr<Recording> recording_from(const Arguments& arguments) {
    if (!arguments.has("--record")) {
        if (arguments.has("--record-truth"))
            throw StartError(Exit::usage,
                             "--record-truth adds comments to a capture; give --record FILE too");
        if (arguments.has("--record-size"))
            throw StartError(Exit::usage,
                             "--record-size splits a capture into several files; give --record FILE too");
        return nullptr;
    }
    constexpr double megabyte = 1e6;
    RecordingLimits limits;
    limits.file_bytes = static_cast<std::uint64_t>(arguments.number("--record-size", 0, 0, 1e9) * megabyte);
    return std::make_unique<Recording>(arguments.text("--record"), limits);
}

void print_recording(const Recording& recording) {
    const RecordingSummary s = recording.summary();
    std::printf("%s%s: %s, %s in %s%s%s\n", padded("recorded", 16).c_str(), recording.file().c_str(),
                counted(s.packets, "packet").c_str(), counted(s.bytes, "byte").c_str(),
                counted(s.files, "file").c_str(),
                s.lost == 0 ? "" : ("; the disk was too slow for " + counted(s.lost, "more packet")).c_str(),
                s.stopped ? "; it stopped early, see above" : "");
}

void print_truth(const TruthFile& truth) {
    const BackgroundFileSummary s = truth.summary();
    std::printf("%s%s: %s, %s%s%s\n", padded("ground truth", 16).c_str(), truth.file().c_str(),
                counted(s.lines, "line").c_str(), counted(s.bytes, "byte").c_str(),
                s.lost == 0 ? "" : ("; the disk was too slow for " + counted(s.lost, "more line")).c_str(),
                s.stopped ? "; it stopped early, see above" : "");
}

/// --control says more than the scenario.
Scenario with_control(Scenario scenario, const Arguments& arguments) {
    if (!arguments.has("--control")) return scenario;
    scenario.control = arguments.text("--control");
    try {
        parse_control_place(scenario.control);
    } catch (const std::invalid_argument& error) {
        throw StartError(Exit::usage, std::string("--control: ") + error.what());
    }
    return scenario;
}

void print_dataset(const Dataset& dataset) {
    const DatasetSummary s = dataset.summary();
    std::printf("%s%s: %s, %s%s\n", padded("data set", 16).c_str(), dataset.folder().c_str(),
                counted(s.pings, "ping").c_str(), counted(s.bytes, "byte").c_str(),
                s.lost == 0 ? "" : ("; there was no time for " + counted(s.lost, "more ping")).c_str());
}

/// A free run that is interrupted is not what was asked for; any other ends so.
void finish(Dataset& dataset, const Runtime& runtime) {
    if (runtime.scenario().clock == ClockMode::free && runtime.interrupted())
        throw StartError(Exit::late, dataset.folder().string() +
                                         ": the run was interrupted, so there is no data set; start it "
                                         "again");
    Progress progress("writing the data set");
    dataset.finish([&](std::size_t done, std::size_t of) { progress.done(done, of); });
}

int run_scenario(const Arguments& arguments) {
    const Scenario scenario = with_control(scenario_from(arguments), arguments);
    const std::optional<double> duration = duration_of(arguments, scenario);
    auto recording = recording_from(arguments);
    const auto truth =
        arguments.has("--truth") ? std::make_unique<TruthFile>(arguments.text("--truth")) : nullptr;
    const auto labels = labels_from(arguments);
    LiveView live_view(arguments);
    const auto dataset =
        arguments.has("--dataset") ? std::make_unique<Dataset>(arguments.text("--dataset")) : nullptr;
    try {
        Runtime runtime(scenario,
                        {.recording = recording ? recording.get() : live_view.recording(),
                         .remarks = arguments.has("--record-truth"),
                         .truth = truth.get(),
                         .labels = labels.get(),
                         .dataset = dataset.get(),
                         .watch = live_view.watch(),
                         .live_faults = live_view.control()},
                        arguments.has("--realtime") ? Punctuality::real_time : Punctuality::ordinary);
        auto page = live_view.serve(runtime);
        const std::string link = page ? page->link() : "";
        const bool json = arguments.has("--json");
        if (json) {
            std::printf("%s\n", run_started_json(runtime, link).c_str());
            std::fflush(stdout);
        } else {
            print_start(runtime, duration, link);
        }
        {
            std::optional<DatasetProgress> progress;
            if (dataset && scenario.clock == ClockMode::free) progress.emplace(*dataset, duration);
            runtime.run(duration);
        }
        page.reset();
        if (recording) recording->finish();
        if (truth) truth->finish();
        if (labels) labels->finish();
        if (dataset) finish(*dataset, runtime);
        const auto sessions = runtime.summary();
        if (json) {
            const auto ended = run_summary_json(sessions, runtime, recording.get(), truth.get(), labels.get(),
                                                dataset.get());
            std::printf("%s\n", ended.c_str());
        } else {
            print_summary(sessions);
            if (const auto poses = runtime.poses())
                print_poses("vehicle", *poses, "the vehicle is, so it stayed at vehicle.pose");
            for (const auto& [name, poses] : runtime.objects())
                print_poses("object " + name, poses,
                            "it is, so it stayed where the scenario or the scene puts it");
            if (const auto steps = runtime.steps()) print_steps(*steps);
            print_stolen(runtime.stolen_seconds());
            print_faults(runtime.faults());
            if (recording) print_recording(*recording);
            if (truth) print_truth(*truth);
            if (labels) print_labels(*labels);
            if (dataset) print_dataset(*dataset);
        }
        std::fflush(stdout);  // before an error
        if (arguments.has("--fail-late")) demand_punctuality(sessions);
    } catch (const StartError&) {
        throw;
    } catch (const SceneError& error) {
        throw StartError(Exit::data, error.what());
    } catch (const std::invalid_argument& error) {
        throw StartError(Exit::config, error.what());
    } catch (const std::runtime_error& error) {
        rethrow_lack_of_memory(error);
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
          "end after this time (stepped clock: time of the run); default: run until Ctrl-C"},
         {Argument::Kind::value, "--record", "FILE", "write the traffic of all ports to a pcapng capture"},
         {Argument::Kind::value, "--record-size", "MB", "start a new capture file after this many megabytes"},
         {Argument::Kind::flag, "--record-truth", "",
          "in the capture, give the sonar's pose in a comment on each ping's first packet"},
         {Argument::Kind::value, "--truth", "FILE",
          "write what is really there, one line of JSON for each ping (docs/truth.md)"},
         view_arguments("the run")[0],
         view_arguments("the run")[1],
         {Argument::Kind::flag, "--view-control", "", "let the page ask for faults"},
         {Argument::Kind::value, "--view-record", "DIR",
          "let the page begin and end recordings, which go into this folder"},
         {Argument::Kind::value, "--dataset", "DIR",
          "write echograms, pictures, labels, truth and bytes of every ping into a new folder "
          "(docs/datasets.md)"},
         {Argument::Kind::value, "--control", "PLACE",
          "accept commands for faults at unix:/PATH or tcp-listen://127.0.0.1:PORT; see echoloop fault"},
         {Argument::Kind::value, "--labels", "FILE", "write one line of JSON for every fault"},
         {Argument::Kind::flag, "--fail-late", "",
          "end with status 75 if a ping was late, or messages or bytes were lost"},
         {Argument::Kind::flag, "--realtime", "",
          "render and answer before all other programs (SCHED_FIFO), from locked memory; needs the "
          "permission to"},
         set_argument(),
         {Argument::Kind::flag, "--json", "", "print one JSON line at the start and one at the end"}},
        "  echoloop run demo\n"
        "  echoloop run demo --view\n"
        "  echoloop run tank --duration 60 --record dive.pcapng\n"
        "  echoloop run tank --truth dive.jsonl\n"
        "  echoloop run sweep --dataset turn\n"
        "  echoloop run faults --labels faults.jsonl --control unix:/tmp/echoloop/control\n"
        "  echoloop run demo --set devices.micron.endpoints='[\"tcp-listen://127.0.0.1:9090\"]'",
        run_scenario};
}

}  // namespace echoloop::cli
