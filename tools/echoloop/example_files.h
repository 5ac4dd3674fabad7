// The example scenarios that come with the program: in ../share/echoloop/examples beside its own folder,
// whether it is installed or was just built.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace echoloop::cli {

struct Example {
    std::string name;            ///< "demo"
    std::filesystem::path file;  ///< absolute
    std::string about;           ///< the first sentence of the file
};

/// By name; empty if the program was copied away from its files.
std::vector<Example> examples();

/// The example of that name where `given` is a bare name ("demo") and no file; else `given` itself. Throws
/// StartError (no_input) for a bare name that is neither.
std::filesystem::path file_or_example(const std::filesystem::path& given);

/// Throws StartError (usage) with the names that are known.
Example example_called(const std::string& name);

}  // namespace echoloop::cli
