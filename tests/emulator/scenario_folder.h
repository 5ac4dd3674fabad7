// A folder of its own for a test program, with a scene file in it, so that messages do not depend on the
// machine.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace echoloop::test {

class ScenarioFolder {
  public:
    ScenarioFolder()
        : path_(std::filesystem::temp_directory_path() /
                ("echoloop-scenario-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path_);
        std::filesystem::current_path(path_);
        std::ofstream("s.glb") << "the loader does not look inside";
    }
    ~ScenarioFolder() {
        std::error_code ignored;
        std::filesystem::current_path("/", ignored);
        std::filesystem::remove_all(path_, ignored);
    }

  private:
    std::filesystem::path path_;
};

/// Makes the folder on first use and the working directory; removed when the program ends.
inline void in_scenario_folder() { static const ScenarioFolder folder; }

}  // namespace echoloop::test
