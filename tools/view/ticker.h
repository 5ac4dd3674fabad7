// Bytes on the wires as named messages for the page. Opens nothing; whatever the bytes hold, it says
// something.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "protocols/stream_decoder.h"
#include "tools/view/feed.h"

namespace echoloop::view {

class Ticker {
  public:
    /// `families`: of the messages of each device, as protocols/inspect.h calls them.
    explicit Ticker(std::map<std::string, std::string> families) : families_(std::move(families)) {}

    /// {"type": "messages", "left_out": bytes, "messages": [{"n", "unix", "device", "port", "sent", "size",
    /// "name", "reason", "fields": [[name, text, unit], ...]}],
    /// "said": the longest array of numbers in the last message of each kind that a device sent: [{"device",
    /// "name", "unit", "numbers"}]}; "" where there are none.
    std::string message_of(const std::vector<Passed>& passed, std::size_t left_out);

  private:
    using Stream = std::pair<std::string, bool>;  ///< port of a device, and direction

    std::map<std::string, std::string> families_;
    std::map<Stream, std::unique_ptr<inspect::StreamDecoder>> streams_;
    std::uint64_t count_ = 0;
};

}  // namespace echoloop::view
