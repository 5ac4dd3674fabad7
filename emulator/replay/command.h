// What a driver's message asks for, so that two of the same kind can be found and compared. Knows fields by
// their names; sends nothing.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "protocols/http/request.h"
#include "protocols/inspect.h"

namespace echoloop::replay {

struct Command {
    std::string key{};  ///< messages of equal keys ask for the same thing: "GeneralRequest requested_id 2300"
    std::vector<std::pair<std::string, double>> values{};  ///< what they may differ in, by field
};

/// Of a decoded message; times, checksums and numbers that only count are left out.
Command command_of(const inspect::Message& message);
/// Of bytes that no family decodes: of text its first line, words and numbers apart; else the bytes
/// themselves.
Command command_of(wire::ByteView bytes);

/// Of a request of HTTP: method and target, and as values the words and numbers of its body.
Command command_of(const http::Request& request);

/// How much two commands of the same key differ; 0: not at all.
double distance(const Command& a, const Command& b);

}  // namespace echoloop::replay
