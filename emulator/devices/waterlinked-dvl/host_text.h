// Cuts what hosts say into commands: documents of JSON, whole with or without a line end, and lines of the
// serial protocol. One for each host; knows no command and no clock.
#pragma once

#include <optional>
#include <string>

#include "emulator/contract/device.h"

namespace echoloop::waterlinked_dvl {

/// What has come and is no command yet.
class HostText {
  public:
    void feed(ByteView bytes, Time now);
    /// The next object or array of JSON; of other characters, all before the next one, as one piece.
    std::optional<std::string> next_document();
    /// The next line, without its end: CR LF, CR or LF. A line that is longer than any command counts as one.
    std::optional<std::string> next_line();
    /// All that there is.
    std::string take_all();
    bool empty() const { return text_.empty(); }
    /// When the first byte of it came.
    Time since() const { return since_; }

  private:
    std::string text_;
    Time since_{};
};

}  // namespace echoloop::waterlinked_dvl
