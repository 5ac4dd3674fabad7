// Whether a file can be read, and its text up to a limit. Never opens anything but a regular file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "emulator/scenario/problems.h"

namespace echoloop::scenario {

struct FileFault {
    Problem::Kind kind;
    std::string message;  ///< does not name the file
};

/// Why the file cannot be read; nullopt if it can.
std::optional<FileFault> file_fault(const std::filesystem::path& file);

/// The text of a scenario file. Throws ScenarioError.
std::string read_scenario_file(const std::filesystem::path& file);

}  // namespace echoloop::scenario
