// What a run answered to `echoloop fault`, for people. Takes any bytes: whoever sits at the place answers.
#pragma once

#include <string>
#include <string_view>

namespace echoloop::cli {

/// True if it is an object of JSON, no deeper than a run's.
bool is_answer(std::string_view answer);
/// True if the run took the token.
bool is_welcome(std::string_view answer);

/// Lines to print, without control characters. Throws StartError: io if this is no answer of a run, data with
/// its reason if the run refused.
std::string text_of_answer(std::string_view answer);

}  // namespace echoloop::cli
