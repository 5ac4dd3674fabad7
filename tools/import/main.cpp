// echoloop-import: makes a scene of a world of another simulator. `echoloop import` starts it.
#include <fcntl.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "emulator/contract/error.h"
#include "tools/echoloop/output_file.h"
#include "tools/import/fault.h"
#include "tools/import/glb.h"
#include "tools/import/options.h"
#include "tools/import/sdf_world.h"

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

/// What runs in the child: reads, writes the scene to `file`, prints the table.
void convert(const Given& given, const fs::path& scratch, const fs::path& file, Stage& stage) {
    const auto start = std::chrono::steady_clock::now();
    const fs::path path = text(given, "WORLD");
    stage.set(printable(path.string()));
    std::vector<std::string> folders = all(given, "--model-path");
    for (const std::string& folder : folders_of_environment()) folders.push_back(folder);
    const ModelPaths paths(path, folders, local_fuel_caches());
    SdfChoices choices{.without = all(given, "--without"),
                       .keep = all(given, "--keep"),
                       .allow_missing = given.contains("--allow-missing")};
    if (given.contains("--materials")) choices.rules = read_material_rules(text(given, "--materials"));
    const Sources sources = collect_sources(path, paths, scratch, choices.allow_missing);
    World world;
    Report report;
    {
        const Hush hush;
        add_sdf(sources, paths, choices, world, report, stage);
    }
    for (const MaterialRule& rule : choices.rules)
        if (!rule.used) report.notes.push_back(rule.place + ": the rule fits nothing");
    stage.set("writing the scene");
    if (world.meshes.empty()) {
        std::string lines;
        for (const std::string& line : report.left_out) lines += "left out: " + line + "\n";
        throw Fault("", lines + printable(path.string()) + ": nothing is left that a sonar could hear",
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
    const fs::path world = text(given, "WORLD"), out = text(given, "--out");
    std::error_code ec;
    if (!fs::is_regular_file(world, ec))
        throw StartError(Exit::no_input, printable(world.string()) +
                                             ": is no file that can be read; name an .sdf, "
                                             ".world or .urdf file");
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
                    convert(given, scratch.path(), file, stage);
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
