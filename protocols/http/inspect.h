// HTTP/1.1 on the ports of sonars as named messages: what a host asks by which path and with which values.
// Bounded; keeps nothing.
#pragma once

#include <optional>

#include "protocols/inspect.h"

namespace echoloop::http {

/// Whether a stream that begins so speaks HTTP: a method and a path, or a status line. No message of a sonar
/// begins with either.
bool begins(wire::ByteView bytes);

/// The request or response that `bytes`, which begin() so, begin with: "PATCH /api/v1/config", the parts of
/// its query and the members of a JSON body as fields; nothing while it is not whole. What is wrong stands in
/// `reason`, and the message then is all of `bytes`. A response is named "200 OK".
std::optional<inspect::Message> first_message(wire::ByteView bytes);

}  // namespace echoloop::http
