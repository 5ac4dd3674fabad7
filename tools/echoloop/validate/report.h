// The table of `echoloop validate` as text and as a Markdown report with pictures. Decides nothing.
#pragma once

#include <filesystem>
#include <string>

#include "tools/echoloop/validate/findings.h"

namespace echoloop::validation {

/// "-91.23", "<= 0.05": the value to meet, and the tolerance beside it where there is one.
std::string published_text(const Quantity& quantity);
std::string tolerance_text(const Quantity& quantity);

/// The table for a terminal, V by V, and a last line with the sum. `coloured`: green and red verdicts.
std::string text_of(const Findings& findings, bool coloured);

/// Writes `file` (Markdown) and, in the folder pictures beside it, a PNG for each plot. Throws StartError
/// with the file and the reason.
void write_report(const Findings& findings, const std::filesystem::path& file);

}  // namespace echoloop::validation
