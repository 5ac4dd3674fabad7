// echoloop-import: makes a scene of a world of another simulator. `echoloop import` starts it.
#include <fcntl.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "emulator/contract/error.h"
#include "tools/echoloop/output_file.h"
#include "tools/echoloop/terminal.h"
#include "tools/import/fault.h"
#include "tools/import/glb.h"
#include "tools/import/options.h"
#include "tools/import/sdf_world.h"
#include "tools/import/terrain/given.h"

namespace echoloop::worlds {
namespace {

namespace fs = std::filesystem;
using Given = std::map<std::string, std::vector<std::string>>;

void print_error(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::fprintf(stderr, "echoloop: error: %s\n", text.substr(at, end - at).c_str());
        at = end + 1;
    }
}

int status(Exit exit) { return static_cast<int>(exit); }

/// The arguments by name; throws CLI's exceptions.
Given parse(int argc, char** argv) {
    CLI::App app("echoloop-import: makes a scene of a world of another simulator", "echoloop import");
    app.set_version_flag("--version", "echoloop-import " ECHOLOOP_VERSION);
    Given given;
    for (const ImportOption& option : options) {
        if (option.kind == ImportOption::Kind::flag) {
            app.add_flag_callback(
                option.name, [&, name = option.name] { given[name] = {}; }, option.help);
            continue;
        }
        const auto keep = [&, name = option.name](const std::vector<std::string>& values) {
            return given[name] = values, true;
        };
        CLI::Option* added = app.add_option(option.name, keep, option.help);
        added->type_name(option.what)->expected(1)->required(option.required);
        if (option.kind == ImportOption::Kind::world)
            added->expected(1, 1000)->take_all()->allow_extra_args();
        if (option.kind == ImportOption::Kind::repeated)
            added->expected(1, 1000)->take_all()->allow_extra_args(false);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) std::exit(app.exit(error));
        throw StartError(Exit::usage, std::string(error.what()) + "; see echoloop import --help");
    }
    return given;
}

/// A folder that vanishes with its owner, who may not be the process that fills it.
class Scratch {
  public:
    Scratch() {
        std::string name = (fs::temp_directory_path() / "echoloop-import-XXXXXX").string();
        if (!::mkdtemp(name.data()))
            throw Fault(name, "cannot be made", "set TMPDIR to a folder that you may write to");
        path_ = fs::canonical(name);
    }
    ~Scratch() {
        std::error_code ec;
        fs::remove_all(path_, ec);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

/// While it lives, what libraries say on standard error goes nowhere: their faults come back as values.
class Hush {
  public:
    Hush() : kept_(::dup(STDERR_FILENO)) {
        std::fflush(stderr);
        const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
        ::dup2(nowhere, STDERR_FILENO);
        ::close(nowhere);
    }
    ~Hush() {
        std::fflush(stderr);
        ::dup2(kept_, STDERR_FILENO);
        ::close(kept_);
    }
    Hush(const Hush&) = delete;
    Hush& operator=(const Hush&) = delete;

  private:
    int kept_;
};

std::vector<std::string> all(const Given& given, const char* name) {
    const auto found = given.find(name);
    return found == given.end() ? std::vector<std::string>{} : found->second;
}

std::string text(const Given& given, const char* name) {
    const auto values = all(given, name);
    return values.empty() ? "" : values.front();
}

std::optional<double> heading_of(const std::string& text) {
    if (text.empty()) return std::nullopt;
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (*end == 0 && std::abs(value) <= 360) return value;
    throw StartError(Exit::usage,
                     "--heading: expected degrees within 360, as in 90, got " + printable(text, 60));
}

/// What WORLD names: at most one that is no survey.
struct Inputs {
    fs::path world;  ///< empty: surveys only
    std::vector<fs::path> surveys;
    TerrainOptions terrain;
    std::optional<double> heading;
};

Inputs inputs_of(const Given& given) {
    Inputs out;
    out.terrain = terrain_options([&](const char* name) { return text(given, name); },
                                  [&](const char* name) { return given.contains(name); });
    out.heading = heading_of(text(given, "--heading"));
    for (const fs::path file : all(given, "WORLD")) {
        std::error_code ec;
        if (!fs::is_regular_file(file, ec))
            throw StartError(Exit::no_input, printable(file.string()) +
                                                 ": is no file that can be read; name an .sdf, .world or "
                                                 ".urdf file, or a survey (.tif, .asc, .grd, .nc, .xyz)");
        if (is_survey(file)) {
            out.surveys.push_back(file);
            continue;
        }
        if (!out.world.empty())
            throw StartError(Exit::usage, printable(file.string()) +
                                              ": is a second world; name one, and surveys beside it");
        require_sdf(file);
        out.world = file;
    }
    return out;
}

void add_world(const Given& given, const Inputs& inputs, const fs::path& scratch, World& world,
               Report& report, Stage& stage) {
    stage.set(printable(inputs.world.string()));
    std::vector<std::string> folders = all(given, "--model-path");
    for (const std::string& folder : folders_of_environment()) folders.push_back(folder);
    const ModelPaths paths(inputs.world, folders, local_fuel_caches());
    SdfChoices choices{.without = all(given, "--without"),
                       .keep = all(given, "--keep"),
                       .allow_missing = given.contains("--allow-missing"),
                       .heading = inputs.heading};
    if (given.contains("--materials")) choices.rules = read_material_rules(text(given, "--materials"));
    const Sources sources = collect_sources(inputs.world, paths, scratch, choices.allow_missing);
    {
        cli::Progress progress("reading shapes");
        const Hush hush;
        add_sdf(sources, paths, choices, world, report, stage,
                [&](std::size_t done, std::size_t of) { progress.done(done, of); });
    }
    for (const MaterialRule& rule : choices.rules)
        if (!rule.used) report.notes.push_back(rule.place + ": the rule fits nothing");
}

void add_surveys(const Given& given, const Inputs& inputs, World& world, Report& report, Stage& stage) {
    for (const fs::path& survey : inputs.surveys) {
        const std::string name = printable(survey.string());
        stage.set(name);
        constexpr double parts = 100'000;  // so many are shown in percent
        cli::Progress progress("making triangles", static_cast<std::size_t>(parts));
        TerrainOptions options = inputs.terrain;
        options.told = [&](double share) { progress.done(static_cast<std::size_t>(parts * share)); };
        for (const std::string& note : add_terrain(world, survey, options))
            report.notes.push_back(name + ": " + printable(note));
        report.add({.model = world.nodes.back().name,
                    .material = inputs.terrain.material,
                    .from = given.contains("--material") ? "--material" : "nothing said",
                    .guessed = !given.contains("--material"),
                    .meshes = 1,
                    .triangles = world.meshes.back().surfaces.back().indices.size() / 3});
        ++report.models;
    }
}

/// What runs in the child: reads, writes the scene to `file`, prints the table.
void convert(const Given& given, const Inputs& inputs, const fs::path& scratch, const fs::path& file,
             Stage& stage) {
    const auto start = std::chrono::steady_clock::now();
    World world;
    Report report;
    if (!inputs.world.empty()) add_world(given, inputs, scratch, world, report, stage);
    add_surveys(given, inputs, world, report, stage);
    stage.set("writing the scene");
    if (world.meshes.empty()) {
        std::string lines;
        for (const std::string& line : report.left_out) lines += "left out: " + line + "\n";
        throw Fault("",
                    lines + printable(inputs.world.string()) + ": nothing is left that a sonar could hear",
                    "keep what was left out with --keep, or name where it is with --model-path");
    }
    try {
        write_glb(world, file);
    } catch (const std::runtime_error& error) {
        throw Fault("", error.what(), "no scene was written");
    }
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::string out = text(given, "--out");
    std::fputs((given.contains("--json") ? report.json(out) : report.text(out)).c_str(), stdout);
}

int import(const Given& given) {
    const Inputs inputs = inputs_of(given);
    const fs::path out = text(given, "--out");
    if (out.extension() != ".glb")
        throw StartError(Exit::usage,
                         "--out: " + printable(out.string()) + " does not end in .glb; name it so");
    cli::require_creatable(out);
    const Scratch scratch;
    int result = 0;
    try {
        cli::write_whole(out, [&](const fs::path& file) {
            result = run_guarded({}, [&](Stage& stage) {
                try {
                    convert(given, inputs, scratch.path(), file, stage);
                    return 0;
                } catch (const Fault& fault) {
                    print_error(fault.what());
                    return status(Exit::data);
                }
            });
            if (result != 0) throw std::runtime_error("told already");
        });
    } catch (const StartError&) {
        if (result == 0) throw;
    }
    return result;
}

}  // namespace
}  // namespace echoloop::worlds

int main(int argc, char** argv) {
    using namespace echoloop;
    try {
        return worlds::import(worlds::parse(argc, argv));
    } catch (const StartError& error) {
        worlds::print_error(error.what());
        return worlds::status(error.exit());
    } catch (const std::exception& error) {
        worlds::print_error(error.what());
        return worlds::status(Exit::data);
    }
}
