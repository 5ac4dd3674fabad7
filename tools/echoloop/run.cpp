// echoloop run: the emulator, until a signal or the end of the time.
#include <cerrno>
#include <cstdio>
#include <optional>

#include "emulator/capture/recording.h"
#include "emulator/faults/control_place.h"
#include "emulator/pose/input.h"
#include "emulator/real_time.h"
#include "emulator/runtime.h"
#include "emulator/step_server.h"
#include "emulator/truth/truth.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/conditions.h"
#include "tools/echoloop/driver.h"
#include "tools/echoloop/faults_output.h"
#include "tools/echoloop/json_run.h"

namespace echoloop::cli {
namespace {

/// Of a run that was asked to be on time, who goes before whom.
std::string claimed(const RealTimeSummary& s) {
    if (!s.needs_workers) return "before all other programs";
    if (s.workers == 0)
        return "before all other programs, but not the kernel's workers, which carry what goes over "
               "pseudo-terminals and serial ports: root, outside of containers, may let them go first";
    return "before all other programs, and until the end " + counted(s.workers, "worker") +
           " of the kernel too, which carry what goes over pseudo-terminals and serial ports";
}

void print_start(const Scenario& scenario, const Runtime& runtime, std::optional<double> duration) {
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
        for (const auto& place : wire_places(device)) std::printf("  %s\n", place_line(place).c_str());
    }
    if (!scenario.control.empty()) line("control", runtime.control());
    if (const auto real_time = runtime.real_time()) line("real time", claimed(*real_time));
    std::printf("For a driver: %s endpoints %s --format ros1 (or ros2, moos, rock, sitl)\n",
                program_invocation_name, scenario.file.c_str());
    const bool stepped = scenario.clock == ClockMode::stepped;
    const std::string end =
        duration ? " for " + plain(*duration, 1) + (stepped ? " s of the run" : " s") : "";
    std::printf("running%s; Ctrl-C ends it\n", end.c_str());
    std::fflush(stdout);
}

/// Why most late pings were late, and what helps.
std::string remedy(const SessionSummary& s) {
    if (2 * s.late_standstills > s.late_pings)
        return "nothing ran on it meanwhile: another machine, or one that is no virtual machine, helps";
    if (2 * s.late_renderings > s.late_pings)
        return "rendering takes too long: fewer sonars, a simpler scene or render: {pixels: 0.5} help";
    if (2 * s.late_wakings > s.late_pings)
        return "other programs or the host had the processors: --realtime and docs/timing.md help";
    return "this machine is too busy or too slow for it";
}

std::string punctuality(const SessionSummary& s) {
    if (s.late_pings == 0) return counted(s.pings, "ping") + ", none late";
    return counted(s.pings, "ping") + ", " + std::to_string(s.late_pings) + " late (" +
           (s.late_standstills == 0
                ? ""
                : std::to_string(s.late_standstills) + " since the machine stood still, ") +
           std::to_string(s.late_renderings) + " waited for their rendering, " +
           std::to_string(s.late_wakings) + " until the machine woke the program), the worst by " +
           plain(to_seconds(s.worst_lateness) * 1e3, 1) + " ms: " + remedy(s);
}

/// Nothing where nothing is missing.
std::string not_taken(std::uint64_t count, const char* thing, const char* fate) {
    if (count == 0) return "";
    return "; " + counted(count, thing) + " " + fate + ", because the driver did not read them";
}

void print_summary(const std::vector<SessionSummary>& sessions) {
    const auto ms = [](Time time) { return plain(to_seconds(time) * 1e3, 2) + " ms"; };
    for (const auto& s : sessions) {
        std::printf("%s%s\n", padded(s.name, 16).c_str(), punctuality(s).c_str());
        if (s.pings > 0)
            std::printf("  after they were due: half of them within %s, 99 of 100 within %s\n",
                        ms(s.median_lateness).c_str(), ms(s.p99_lateness).c_str());
        std::printf("  from the driver: %s, %s understood, %s refused, %s of noise skipped\n",
                    counted(s.bytes_in, "byte").c_str(), counted(s.device.messages, "message").c_str(),
                    std::to_string(s.device.rejected).c_str(),
                    counted(s.device.skipped_bytes, "byte").c_str());
        std::printf("  to the driver: %s, at most %s at once in the queue%s%s\n",
                    counted(s.bytes_out, "byte").c_str(), counted(s.most_waiting, "message").c_str(),
                    not_taken(s.bytes_lost, "byte", "lost").c_str(),
                    not_taken(s.dropped, "message", "dropped").c_str());
    }
}

/// Throws StartError if a deadline was missed.
void demand_punctuality(const std::vector<SessionSummary>& sessions) {
    for (const auto& s : sessions)
        if (s.late_pings > 0 || s.dropped > 0 || s.bytes_lost > 0)
            throw StartError(Exit::late, s.name + ": " + counted(s.late_pings, "late ping") + ", " +
                                             counted(s.dropped, "dropped message") + " and " +
                                             counted(s.bytes_lost, "lost byte") +
                                             ", and --fail-late allows none; " +
                                             (s.late_pings > 0 ? remedy(s) : "the driver must read faster"));
}

/// nullptr without --record.
std::unique_ptr<Recording> recording_from(const Arguments& arguments) {
    if (!arguments.has("--record")) {
        if (arguments.has("--record-truth"))
            throw StartError(Exit::usage, "--record-truth needs --record FILE, whose packets it comments");
        if (arguments.has("--record-size"))
            throw StartError(Exit::usage, "--record-size needs --record FILE, which it splits into several");
        return nullptr;
    }
    constexpr double megabyte = 1e6;
    RecordingLimits limits;
    limits.file_bytes = static_cast<std::uint64_t>(arguments.number("--record-size", 0, 0, 1e9) * megabyte);
    return std::make_unique<Recording>(arguments.text("--record"), limits);
}

/// `untold`: what became of it if nobody said where it is.
void print_poses(const std::string& name, const PoseSummary& s, const char* untold) {
    std::printf("%s%s from %s, %llu refused%s, %s, %s with a stale pose%s%s\n", padded(name, 16).c_str(),
                counted(s.accepted, "pose").c_str(), s.place.c_str(),
                static_cast<unsigned long long>(s.refused),
                s.refused == 0 ? "" : (" (the last: " + s.last_refusal + ")").c_str(),
                counted(s.jumps, "jump").c_str(), counted(s.stale_pings, "ping").c_str(),
                s.accepted == 0 ? ": nobody said where " : "", s.accepted == 0 ? untold : "");
}

void print_steps(const StepSummary& s) {
    std::printf("%s%s to %s s of the run, %llu refused%s\n", padded("clock", 16).c_str(),
                counted(s.steps, "step").c_str(), plain(to_seconds(s.run_time), 3).c_str(),
                static_cast<unsigned long long>(s.refused),
                s.refused == 0 ? "" : (" (the last: " + s.last_refusal + ")").c_str());
}

void print_standstills(const Standstills::Summary& s) {
    const double longest = std::chrono::duration<double, std::milli>(s.longest).count();
    std::printf("%s%s\n", padded("machine", 16).c_str(),
                s.count == 0
                    ? "never stood still"
                    : ("stood still " + counted(s.count, "time") + ", at most " + plain(longest, 1) + " ms" +
                       (s.fetched == 0
                            ? ""
                            : "; the wires were served by another processor " + counted(s.fetched, "time")))
                          .c_str());
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

int run(const Arguments& arguments) {
    const Scenario scenario = with_control(scenario_from(arguments), arguments);
    std::optional<double> duration;
    if (arguments.has("--duration")) duration = arguments.number("--duration", 0, 0, 1e9);
    auto recording = recording_from(arguments);
    const auto truth =
        arguments.has("--truth") ? std::make_unique<TruthFile>(arguments.text("--truth")) : nullptr;
    const auto labels = labels_from(arguments);
    try {
        Runtime runtime(scenario,
                        {.recording = recording.get(),
                         .remarks = arguments.has("--record-truth"),
                         .truth = truth.get(),
                         .labels = labels.get()},
                        arguments.has("--realtime") ? Punctuality::real_time : Punctuality::ordinary);
        const bool json = arguments.has("--json");
        if (json) {
            std::printf("%s\n", run_started_json(scenario, runtime).c_str());
            std::fflush(stdout);
        } else {
            print_start(scenario, runtime, duration);
        }
        runtime.run(duration);
        if (recording) recording->finish();
        if (truth) truth->finish();
        if (labels) labels->finish();
        const auto sessions = runtime.summary();
        if (json) {
            const auto ended =
                run_summary_json(sessions, runtime, recording.get(), truth.get(), labels.get());
            std::printf("%s\n", ended.c_str());
        } else {
            print_summary(sessions);
            if (const auto poses = runtime.poses())
                print_poses("vehicle", *poses, "the vehicle is, and it stayed where vehicle.pose puts it");
            for (const auto& [name, poses] : runtime.objects())
                print_poses("object " + name, poses,
                            "it is, and it stayed where the scenario or the scene puts it");
            if (const auto steps = runtime.steps()) print_steps(*steps);
            if (const auto real_time = runtime.real_time()) print_standstills(real_time->standstills);
            print_faults(runtime.faults());
            if (recording) print_recording(*recording);
            if (truth) print_truth(*truth);
            if (labels) print_labels(*labels);
        }
        if (arguments.has("--fail-late")) demand_punctuality(sessions);
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
          "end after this time (stepped clock: of the run's time); without it: run until Ctrl-C"},
         {Argument::Kind::value, "--record", "FILE",
          "write what every port hears and says to a pcapng capture"},
         {Argument::Kind::value, "--record-size", "MB", "begin another capture file after so many megabytes"},
         {Argument::Kind::flag, "--record-truth", "",
          "in the capture, each ping's first packet says in a comment where its sonar was"},
         {Argument::Kind::value, "--truth", "FILE",
          "write what is really there at every ping, a line of JSON each (docs/truth.md)"},
         {Argument::Kind::value, "--control", "PLACE",
          "take faults while it runs, at unix:/PATH or tcp-listen://127.0.0.1:PORT; see echoloop fault"},
         {Argument::Kind::value, "--labels", "FILE", "write a line of JSON for every fault that is made"},
         {Argument::Kind::flag, "--fail-late", "",
          "end with status 75 if a ping was late, or a message or bytes were lost"},
         {Argument::Kind::flag, "--realtime", "",
          "render and answer before all other programs, from locked memory; needs the permission to"},
         set_argument(),
         {Argument::Kind::flag, "--json", "", "print one JSON line at the start and one at the end"}},
        "  echoloop run config/demo.yaml\n"
        "  echoloop run config/tank.yaml --duration 60 --record dive.pcapng\n"
        "  echoloop run config/tank.yaml --truth dive.jsonl\n"
        "  echoloop run config/faults.yaml --labels faults.jsonl --control unix:/tmp/echoloop/control\n"
        "  echoloop run config/demo.yaml --set devices.micron.endpoints='[\"tcp-listen://127.0.0.1:9090\"]'",
        run};
}

}  // namespace echoloop::cli
