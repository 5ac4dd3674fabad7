// The manual page and the shells' completions, made from the table of verbs. Text only; nothing is written.
#pragma once

#include <span>
#include <string>

#include "tools/echoloop/verb.h"

namespace echoloop::cli::manual {

/// Verbs of the help, without the hidden ones.
std::vector<const Verb*> shown_verbs();

/// Whether it takes a scenario: a file or the name of an example.
bool is_scenario(const Argument& argument);
/// Whether its value is the name of a file or folder.
bool is_file(const Argument& argument);
/// Whether it begins with "--".
bool is_option(const Argument& argument);

/// In mdoc(7). `date`: as in "November 26, 2026".
std::string man_page(const std::string& date);
std::string bash_completion();
std::string zsh_completion();
std::string fish_completion();

}  // namespace echoloop::cli::manual
