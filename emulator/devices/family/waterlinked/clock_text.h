// Times as Water Linked's sonars write them (RFC 3339), and who serves them. Pure functions.
#pragma once

#include <optional>
#include <string>

namespace echoloop::waterlinked_family {

/// "2026-08-17T10:00:00.250000Z" from s since 1970.
std::string rfc3339(double unix_time);
/// With a fraction or without, with Z or an offset like +02:00; nothing if it is no time.
std::optional<double> read_rfc3339(const std::string& text);
/// A name or an address: letters, digits, dots, colons and dashes.
bool is_host(const std::string& text);

}  // namespace echoloop::waterlinked_family
