// Reads captures for `echoloop convert`: whole messages of one device for a maker's recording, all messages
// for a table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/echoloop/convert/recording.h"

namespace echoloop::convert {

struct Source {
    std::string file;     ///< read twice, so no standard input
    std::string line{};   ///< port of the capture: name, address, number; "": the only one
    std::string message;  ///< of a table: the only kind of message; "": all
};

struct Written {
    std::size_t count = 0, lost = 0;
    std::vector<std::string> troubles{};  ///< of the capture
};

/// In the first of these formats whose family is spoken. Throws StartError: (usage) if several lines speak it
/// and none is chosen, (data) if none does.
Written write_recording(const Source& source, const std::vector<Format>& kinds,
                        const std::filesystem::path& out);

/// A row for each message: time in s, direction, name, and a column for each field; arrays are numbers with
/// blanks between. Throws StartError (data) if there is no message.
Written write_table(const Source& source, const std::filesystem::path& out);

}  // namespace echoloop::convert
