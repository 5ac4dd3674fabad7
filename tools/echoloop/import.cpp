// echoloop import: starts echoloop-import, a program and a package of its own, because its libraries are
// many. Reads no world itself.
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "emulator/contract/error.h"
#include "tools/echoloop/verb.h"
#include "tools/import/options.h"

namespace echoloop::cli {
namespace {

using worlds::ImportOption;

std::vector<Argument> rows() {
    std::vector<Argument> out;
    for (const ImportOption& option : worlds::options) {
        const auto kind = option.kind == ImportOption::Kind::world   ? Argument::Kind::positional
                          : option.kind == ImportOption::Kind::flag  ? Argument::Kind::flag
                          : option.kind == ImportOption::Kind::value ? Argument::Kind::value
                                                                     : Argument::Kind::repeated;
        out.push_back({kind, option.name, option.what, option.help, {}, option.required});
    }
    return out;
}

std::vector<std::string> words_of(const Arguments& arguments) {
    std::vector<std::string> out{"echoloop-import"};
    for (const ImportOption& option : worlds::options) {
        if (option.kind == ImportOption::Kind::flag && arguments.has(option.name))
            out.emplace_back(option.name);
        if (option.kind == ImportOption::Kind::flag || option.kind == ImportOption::Kind::world) continue;
        for (const std::string& value : arguments.all(option.name))
            out.push_back(std::string(option.name) + "=" + value);
    }
    out.insert(out.end(), {"--", arguments.text("WORLD")});
    return out;
}

/// Beside this program, else in PATH.
int run_import(const Arguments& arguments) {
    std::vector<std::string> words = words_of(arguments);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    std::error_code ec;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", ec);
    ::execv((self.parent_path() / "echoloop-import").c_str(), argv.data());
    if (errno == ENOENT) ::execvp("echoloop-import", argv.data());
    if (errno == ENOENT)
        throw StartError(
            Exit::unavailable,
            "echoloop-import is not installed; install its package: apt-get install echoloop-import "
            "(a build from source makes it where libsdformat-dev, libassimp-dev and libgdal-dev are)");
    throw StartError(Exit::os_error,
                     std::string("echoloop-import cannot be started: ") + std::strerror(errno));
}

}  // namespace

Verb import_verb() {
    return {"import", "make a scene of a Gazebo world (SDF) or a robot (URDF)", rows(),
            "  echoloop import wreck.world --out wreck.glb --model-path ~/models\n"
            "  echoloop import harbour.sdf --out harbour.glb --materials map.yaml --without rexrov",
            run_import};
}

}  // namespace echoloop::cli
