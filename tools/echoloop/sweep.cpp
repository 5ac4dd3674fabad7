// echoloop sweep: many runs of one scenario, each with values of its own, into one folder for each.
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "emulator/capture/recording.h"
#include "emulator/dataset/dataset.h"
#include "emulator/run/kept_scene.h"
#include "emulator/run/runtime.h"
#include "emulator/scenario/number.h"
#include "emulator/scenario/sweep.h"
#include "emulator/truth/truth.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/example_files.h"
#include "tools/echoloop/json_run.h"
#include "tools/echoloop/terminal.h"

namespace echoloop::cli {
namespace {

namespace fs = std::filesystem;

/// The runs index, index + step, ... below the end.
struct Part {
    std::uint64_t first = 0, step = 1;
};

std::uint64_t whole_of(const std::string& text, const std::string& what) {
    const auto number = scenario::parse_as<std::uint64_t>(text);
    if (!number)
        throw StartError(Exit::usage, what + ": expected a whole number, got " + scenario::in_quotes(text));
    return *number;
}

/// The number that a scheduler has given to this task.
std::uint64_t task_number() {
    for (const char* name : {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX"})
        if (const char* text = std::getenv(name)) return whole_of(text, name);
    throw StartError(
        Exit::usage,
        "--shard task/N: neither SLURM_ARRAY_TASK_ID nor JOB_COMPLETION_INDEX is set; give --shard I/N");
}

Part shard_of(const std::string& text) {
    const auto slash = text.find('/');
    if (slash == std::string::npos)
        throw StartError(Exit::usage,
                         "--shard: expected I/N, as in 0/8, or task/N, got " + scenario::in_quotes(text));
    const std::string which = text.substr(0, slash);
    Part part;
    part.step = whole_of(text.substr(slash + 1), "--shard");
    part.first = which == "task" ? task_number() : whole_of(which, "--shard");
    if (part.step == 0 || part.first >= part.step)
        throw StartError(Exit::usage,
                         "--shard: of N shards the numbers are 0 to N - 1, got " + scenario::in_quotes(text));
    return part;
}

Part part_of(const Arguments& arguments, std::uint64_t runs) {
    if (arguments.has("--index") && arguments.has("--shard"))
        throw StartError(Exit::usage, "--index is one run and --shard a part of them all; give one of both");
    if (arguments.has("--shard")) return shard_of(arguments.text("--shard"));
    if (!arguments.has("--index")) return {};
    const std::uint64_t index = whole_of(arguments.text("--index"), "--index");
    if (index >= runs)
        throw StartError(Exit::usage, "--index: the sweep has " + counted(runs, "run") + ", counted from 0");
    return {index, runs};
}

std::string folder_name(std::uint64_t index) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "%06llu", static_cast<unsigned long long>(index));
    return name.data();
}

void write_text(const fs::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text << '\n';
    out.close();
    if (!out)
        throw StartError(Exit::io, "cannot write " + file.string() + ": " + std::strerror(errno) +
                                       "; make room there and start it again");
}

std::string values_json(const Sweep& sweep, std::uint64_t index) {
    nlohmann::ordered_json json{{"index", index}};
    for (const auto& [path, value] : sweep.values(index)) {
        const auto number = nlohmann::ordered_json::parse(value, nullptr, false);
        json["values"][path] = number.is_number() ? number : nlohmann::ordered_json(value);
    }
    return json.dump();
}

double duration_of(const Scenario& scenario) {
    if (scenario.clock != ClockMode::free || !scenario.duration)
        throw StartError(Exit::config,
                         scenario.file.string() +
                             ": a sweep's runs have nobody outside and end by themselves; add clock: "
                             "{mode: free, duration: SECONDS}");
    return *scenario.duration;
}

/// One run as a whole, or nothing of it; false: another process is at it.
bool make_run(const Sweep& sweep, std::uint64_t index, const fs::path& out, bool with_dataset,
              KeptScene& kept) {
    AsideFolder aside(out / folder_name(index));
    if (!aside.mine()) return false;
    const Scenario scenario = sweep.scenario(index);
    const double duration = duration_of(scenario);
    Recording recording(aside.path() / "capture.pcapng");
    TruthFile truth(aside.path() / "truth.jsonl");
    std::optional<BackgroundFile> labels;
    if (!scenario.faults.empty()) labels.emplace(aside.path() / "labels.jsonl", "the labels");
    std::optional<Dataset> dataset;
    if (with_dataset) dataset.emplace(aside.path() / "dataset");
    Runtime runtime(scenario,
                    {.recording = &recording,
                     .truth = &truth,
                     .labels = labels ? &*labels : nullptr,
                     .dataset = dataset ? &*dataset : nullptr},
                    Punctuality::ordinary, &kept);
    runtime.run(duration);
    recording.finish();
    truth.finish();
    if (labels) labels->finish();
    if (runtime.interrupted())
        throw StartError(Exit::late, "run " + std::to_string(index) + " was interrupted; start it again");
    if (dataset) dataset->finish();
    const RecordingSummary recorded = recording.summary();
    if (recorded.lost > 0 || recorded.stopped || truth.summary().lost > 0 || truth.summary().stopped)
        throw StartError(Exit::io, "run " + std::to_string(index) +
                                       " is not whole: the disk is full or too slow; make room in " +
                                       out.string() + " and start it again");
    write_text(aside.path() / "values.json", values_json(sweep, index));
    aside.finish();
    return true;
}

/// Throws StartError if it is, without the data set that is wanted.
bool is_there(const fs::path& run, bool with_dataset) {
    if (!fs::exists(run)) return false;
    if (with_dataset && !fs::exists(run / "dataset"))
        throw StartError(Exit::cannot_create,
                         run.string() + ": was made without --dataset; name another folder with --out");
    return true;
}

int run_sweep(const Arguments& arguments) {
    const Sweep sweep =
        Sweep::load(file_or_example(arguments.text("FILE")), arguments.all("--set"), models());
    const Part part = part_of(arguments, sweep.runs());
    if (arguments.has("--print")) {
        std::printf("%s", sweep.resolved(part.first).c_str());
        return 0;
    }
    if (!arguments.has("--out"))
        throw StartError(Exit::usage, "give --out DIR, a folder for the runs, or --print");
    const fs::path out = arguments.text("--out");
    duration_of(sweep.scenario(part.first));
    const bool with_dataset = arguments.has("--dataset");
    KeptScene kept;
    std::uint64_t made = 0, there = 0, elsewhere = 0, done = 0;
    const std::uint64_t all =
        part.first >= sweep.runs() ? 0 : (sweep.runs() - part.first - 1) / part.step + 1;
    Progress progress("runs", all);
    for (std::uint64_t index = part.first; index < sweep.runs(); index += part.step) {
        if (is_there(out / folder_name(index), with_dataset))
            ++there;
        else if (make_run(sweep, index, out, with_dataset, kept))
            ++made;
        else
            ++elsewhere;
        progress.done(++done);
    }
    std::printf("%s made, %llu were there, %llu are being made elsewhere: %s\n", counted(made, "run").c_str(),
                static_cast<unsigned long long>(there), static_cast<unsigned long long>(elsewhere),
                out.string().c_str());
    return elsewhere == 0 ? 0 : static_cast<int>(Exit::late);
}

}  // namespace

Verb sweep_verb() {
    using Kind = Argument::Kind;
    return {
        "sweep",
        "many runs of one scenario, each with values of its own",
        {scenario_argument(),
         set_argument(),
         {Kind::value, "--out", "DIR",
          "folder that gets a folder for each run; those that are there are not made again"},
         {Kind::flag, "--dataset", "", "each run's folder gets a data set too (docs/datasets.md)"},
         {Kind::value, "--index", "N", "one run alone, counted from 0"},
         {Kind::value, "--shard", "I/N",
          "every Nth run from the Ith on, I from 0; task/N takes I from SLURM_ARRAY_TASK_ID or "
          "JOB_COMPLETION_INDEX"},
         {Kind::flag, "--print", "", "show the scenario of the first of these runs, and make none"}},
        "  echoloop sweep dive.yaml --out runs\n"
        "  echoloop sweep dive.yaml --index 17 --print\n"
        "  echoloop sweep dive.yaml --shard task/100 --out runs\n"
        "  echoloop sweep dive.yaml --out runs --dataset\n"
        "Exit status: 0, all is there; 74 and 75, try again (disk, interrupted, another process is at it);\n"
        "64, 65, 66, 78: the command line, a file or the scenario is wrong, and trying again will not "
        "help.\n",
        run_sweep};
}

}  // namespace echoloop::cli
