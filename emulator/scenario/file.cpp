#include "emulator/scenario/file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

namespace echoloop::scenario {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 20;

[[noreturn]] void refuse(const std::filesystem::path& file, Problem::Kind kind, std::string message) {
    throw ScenarioError({{kind, file.string(), 0, 0, std::move(message)}});
}

}  // namespace

std::optional<FileFault> file_fault(const std::filesystem::path& file) {
    using Kind = Problem::Kind;
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found)
        return FileFault{Kind::missing_file, "no such file"};
    if (error == std::errc::permission_denied)
        return FileFault{Kind::no_permission, "no permission to look into its folder"};
    if (error) return FileFault{Kind::missing_file, error.message()};
    if (status.type() != std::filesystem::file_type::regular)
        return FileFault{Kind::missing_file, "not a regular file"};
    if (::access(file.c_str(), R_OK) != 0) return FileFault{Kind::no_permission, "no permission to read it"};
    return {};
}

std::string read_scenario_file(const std::filesystem::path& file) {
    if (const auto fault = file_fault(file)) refuse(file, fault->kind, fault->message);
    if (file.extension() == ".glb" || file.extension() == ".gltf")
        refuse(file, Problem::Kind::invalid,
               "a scene is no scenario; write one that names it, with scene: " + file.string() +
                   " and devices: [{name: micron, model: tritech-micron}]");
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    if (error || size > largest_file)
        refuse(file, Problem::Kind::invalid, "larger than 1 MiB; this is not a scenario");
    std::ifstream stream(file, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(stream), {});
    if (stream.bad() || text.size() > largest_file)
        refuse(file, Problem::Kind::invalid, std::string("cannot be read: ") + std::strerror(errno));
    return text;
}

}  // namespace echoloop::scenario
