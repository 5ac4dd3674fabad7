// What the pose programs tell a person: one line on standard error with the program's name before it. Nothing
// of it is for machines.
#pragma once

#include <string>
#include <string_view>

namespace echoloop::poses {

/// The name that lines begin with from now on.
void name_program(const std::string& name);
void say(const std::string& line);

/// Printable characters of text from outside, cut at 200.
std::string harmless(std::string_view text);

}  // namespace echoloop::poses
