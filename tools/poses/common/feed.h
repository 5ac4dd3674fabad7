// What becomes of the poses that a program hears: whose they are, in which axes, whether they step the clock,
// and how many of them. Knows no middleware.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tools/poses/common/options.h"
#include "tools/poses/common/sender.h"

namespace echoloop::poses {

class Feed {
  public:
    Feed(const Options& options, Sender& sender);

    /// Who is told of each step that the emulator has made, with the stamp that it was made for.
    void on_step(std::function<void(Nanoseconds stamp)> told) { told_ = std::move(told); }

    /// The bodies of one message on a topic of the sources; each source takes the one that it names.
    void heard(const std::string& topic, const std::vector<BodyPose>& bodies);
    /// The pose of one source.
    void heard(const Source& source, const BodyPose& body);
    /// A message that cannot be read.
    void refused(const std::string& topic, const std::string& reason);
    /// Simulated time.
    void clock(Nanoseconds time);
    /// Nothing came for a moment; says once for each topic that no pose has come from it for long.
    void idle();

    /// Says how many of everything there were; to standard output.
    void print_summary() const;

  private:
    void step(const std::string& line, Nanoseconds now);
    Nanoseconds run_time(Nanoseconds stamp);

    const Options& options_;
    Sender& sender_;
    std::function<void(Nanoseconds)> told_;
    std::optional<Nanoseconds> zero_, now_;      ///< of a stepped run
    std::map<std::string, std::uint64_t> sent_;  ///< by what moves
    std::uint64_t refused_ = 0, lost_ = 0, late_ = 0, steps_ = 0;
    std::string last_refusal_;
    std::set<std::string> awaited_;  ///< topics of which nothing has come, and nothing has been said
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

}  // namespace echoloop::poses
