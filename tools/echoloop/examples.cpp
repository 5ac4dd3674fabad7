// echoloop examples: the example scenarios, and copies of them to change.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <set>

#include "emulator/contract/error.h"
#include "emulator/scenario/section.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/example_files.h"
#include "tools/echoloop/json_line.h"

namespace echoloop::cli {
namespace fs = std::filesystem;
namespace {

int list(const Arguments& arguments) {
    const auto all = examples();
    if (all.empty()) example_called("");  // says why
    if (arguments.has("--json")) {
        nlohmann::ordered_json json{{"examples", nlohmann::ordered_json::array()}};
        for (const Example& example : all)
            json["examples"].push_back(
                {{"name", example.name}, {"file", example.file.string()}, {"about", example.about}});
        std::printf("%s\n", line_of(json).c_str());
        return 0;
    }
    std::size_t width = 0;
    for (const Example& example : all) width = std::max(width, example.name.size() + 2);
    for (const Example& example : all)
        std::printf("%s%s\n", padded(example.name, width).c_str(), example.about.c_str());
    return 0;
}

/// The scenario and the files that it names.
std::set<fs::path> files_of(const fs::path& file) {
    const Scenario scenario = load_scenario(file, {}, models());
    std::set<fs::path> files{scenario.file, scenario.scene};
    if (!scenario.trajectory.empty()) files.insert(scenario.trajectory);
    for (const ScenarioObject& object : scenario.objects)
        if (!object.trajectory.empty()) files.insert(object.trajectory);
    return files;
}

std::string content_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Two examples may use the same scene.
bool is_there_already(const fs::path& from, const fs::path& to) {
    std::error_code ec;
    if (!fs::exists(fs::symlink_status(to, ec))) return false;
    if (from.extension() != ".yaml" && fs::is_regular_file(to, ec) && content_of(from) == content_of(to))
        return true;
    throw StartError(Exit::cannot_create,
                     scenario::in_quotes(to.string()) + " exists already; remove it, or name another folder");
}

void make_copy(const fs::path& from, const fs::path& to) {
    std::error_code ec;
    fs::create_directories(to.parent_path(), ec);
    if (!ec) fs::copy_file(from, to, ec);
    if (ec)
        throw StartError(ec == std::errc::permission_denied ? Exit::no_permission : Exit::cannot_create,
                         "cannot create " + scenario::in_quotes(to.string()) + ": " + ec.message() +
                             "; name a folder that you may write to");
    fs::permissions(to, fs::perms::owner_write, fs::perm_options::add, ec);
}

int copy(const Arguments& arguments) {
    if (!arguments.has("NAME")) throw StartError(Exit::usage, "which example? echoloop examples lists them");
    const Example example = example_called(arguments.text("NAME"));
    const fs::path folder = arguments.text("FOLDER", ".");
    std::vector<std::pair<fs::path, fs::path>> missing;
    for (const fs::path& from : files_of(example.file)) {
        const auto to = (folder / from.lexically_relative(example.file.parent_path())).lexically_normal();
        if (!is_there_already(from, to)) missing.emplace_back(from, to);
    }
    for (const auto& [from, to] : missing) make_copy(from, to);
    for (const auto& [from, to] : missing) std::printf("%s\n", to.c_str());
    return 0;
}

int run(const Arguments& arguments) { return arguments.has("copy") ? copy(arguments) : list(arguments); }

}  // namespace

Verb examples_verb() {
    using Kind = Argument::Kind;
    return {"examples",
            "list the example scenarios, or copy one to change it",
            {{Kind::optional, "copy", "", "copy an example with its scene instead", {"copy"}},
             {Kind::optional, "NAME", "", "the example to copy"},
             {Kind::optional, "FOLDER", "", "where to; default: the working directory"},
             json_argument()},
            "  echoloop examples\n"
            "  echoloop examples copy demo my_dive",
            run};
}

}  // namespace echoloop::cli
