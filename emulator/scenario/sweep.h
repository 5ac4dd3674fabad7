// A scenario of many runs: the section `sweep` says which values differ from run to run, and how. The values
// of a run depend on the seed, its index and their keys only, so that any run can be made again alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "emulator/scenario/scenario.h"

namespace echoloop {

class Sweep {
  public:
    /// Reads `file` and checks its first run. Throws ScenarioError as load_scenario() does, also for a file
    /// without a sweep.
    static Sweep load(const std::filesystem::path& file, const std::vector<std::string>& set_arguments,
                      std::span<const Model> models);
    Sweep(Sweep&&) noexcept;
    ~Sweep();

    std::uint64_t runs() const;
    /// {"water.temperature", "11.25"} for each path that varies, in the file's order, and the run's seed:
    /// what
    /// --set would say.
    std::vector<std::pair<std::string, std::string>> values(std::uint64_t index) const;
    /// Throws ScenarioError; what a value of the sweep spoils is reported at its place in the file.
    Scenario scenario(std::uint64_t index) const;
    /// The YAML of that run, complete.
    std::string resolved(std::uint64_t index) const;

  private:
    struct Impl;
    explicit Sweep(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace echoloop
