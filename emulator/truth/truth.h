// Ground truth beside the bytes: one JSON line for each ping, with what is really there. A thread of its own
// puts the lines into words and on the disk; nothing of it comes back to a device.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "emulator/capture/background_file.h"
#include "emulator/contract/device.h"
#include "render/motion.h"
#include "render/water.h"

namespace echoloop {

/// The first line: what holds for the whole run.
struct TruthHeader {
    struct Device {
        std::string name, model;
        Pose body_from_sonar;
    };
    std::string scenario, scene;
    std::uint64_t seed = 0;
    double unix_start = 0;               ///< s since 1970
    std::vector<std::string> objects{};  ///< by their numbers in the lines, from 1 on
    std::vector<std::string> movers{};   ///< things that move, in the order of Situation::movers
    std::vector<Device> devices{};
    Water water{};
};

/// What a line is made of.
struct PingTruth {
    std::string device;
    Time transmitted{}, due{};
    double unix_time = 0;      ///< s since 1970, of the transmission
    std::vector<Pose> movers;  ///< Situation::movers
    Pose world_from_body;
    Motion sonar;   ///< Situation::velocity and ::turning
    Echogram echo;  ///< without its values
    /// For who asks: objects within the main lobes, by their numbers in the lines, and how much of each no
    /// other hides, 0..1.
    std::vector<std::pair<std::uint32_t, double>> visible{};
    std::vector<std::string> faults;  ///< kinds and numbers of those that were on when it was heard
};

/// The texts, as docs/truth.md says; without the ends of lines.
std::string truth_header_line(const TruthHeader& header);
void append_truth_line(const PingTruth& ping, std::string& text);

class TruthFile {
  public:
    /// Throws StartError if the file cannot be made.
    explicit TruthFile(std::filesystem::path file, BackgroundFileLimits limits = {})
        : file_(std::move(file), "the ground truth", limits) {}

    /// Before the first ping.
    void begin(const TruthHeader& header) { file_.add(truth_header_line(header)); }
    void add(PingTruth ping);
    void finish() { file_.finish(); }

    BackgroundFileSummary summary() const { return file_.summary(); }
    const std::filesystem::path& file() const { return file_.file(); }

  private:
    BackgroundFile file_;
};

}  // namespace echoloop
