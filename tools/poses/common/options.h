// What the pose programs are told on their command lines. Opens nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/contract/endpoint.h"
#include "tools/poses/common/body_pose.h"

namespace echoloop::poses {

struct Options {
    Endpoint to;
    std::vector<Source> sources;
    bool ned = false;
    bool step = false;
    std::optional<Nanoseconds> zero;  ///< the stamp that is second 0 of a stepped run; empty: the first one
    std::string clock;                ///< topic of simulated time, which steps as well; empty: none
    std::string answer;               ///< topic that is told of each step's end; empty: none
    std::string world = "map";        ///< root frame of transforms
    std::string server;               ///< rosbridge only: ws://host:port/path
    std::vector<std::pair<std::string, std::string>> types;  ///< of topics
};

/// What differs among the programs.
struct Program {
    std::string name, purpose, examples;
    std::string clock_help;
    bool transforms = false;  ///< takes --world
    bool server = false;      ///< takes --server
    bool types = false;       ///< takes --type
};

/// Throws StartError (usage) with a remedy. Empty if help or version was asked for and has been printed.
std::optional<Options> read_options(int argc, const char* const* argv, const Program& program);

/// All topics of the sources, each once, in their order.
std::vector<std::string> topics_of(const Options& options);

}  // namespace echoloop::poses
