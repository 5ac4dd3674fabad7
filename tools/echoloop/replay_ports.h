// Which ports of a capture are played where, as the command line says. Opens no endpoint.
#pragma once

#include <string>
#include <vector>

#include "emulator/contract/endpoint.h"
#include "tools/capture/ports.h"
#include "tools/echoloop/replay_source.h"
#include "tools/echoloop/verb.h"

namespace echoloop::cli {

/// A port of the capture, and where it is played.
struct Assignment {
    PlayedPort port;
    std::string name;  ///< as a person calls it
    Endpoint endpoint;
    bool datagrams = false;               ///< captured as such
    std::uint64_t pieces = 0, bytes = 0;  ///< that the played side says
    double begin = 0, end = 0;            ///< s, as in the capture
};

/// By --interval; in the parts that devices send.
capture::OpenSettings settings_for_playing(const Arguments& arguments);
/// By --family; nullptr without. Throws StartError (usage).
const inspect::Family* family_asked_for(const Arguments& arguments);

/// One line a port, for people: name, and what each side says.
std::string ports_text(const capture::Survey& survey);

/// From ENDPOINT and --port, or from --play. Throws StartError (usage), naming the ports of the capture.
std::vector<Assignment> assignments_from(const Arguments& arguments, const capture::Survey& survey);

}  // namespace echoloop::cli
