// A folder for what a run makes: links to pseudo-terminals, a control socket.
#pragma once

#include <filesystem>
#include <string>

namespace echoloop {

/// The place to name instead of one that cannot be had: the user's folder of this login
/// ($XDG_RUNTIME_DIR/echoloop), where nobody else may write, or one of that user's number in /tmp.
std::filesystem::path place_of_ones_own();

/// Makes `folder` if it is missing. Where everybody may make one, as in /tmp, one that another user made (or
/// a link to anywhere) is refused: that user could exchange what is in it at any time. `what`: the beginning
/// of the message; `instead`: a place to name. Throws StartError.
void make_own_folder(const std::filesystem::path& folder, const std::string& what,
                     const std::string& instead);

}  // namespace echoloop
