// Cuts what one side says on a port into whole messages, and says what each is. In bounded memory, whatever
// the bytes are.
#pragma once

#include <functional>

#include "emulator/contract/device.h"
#include "emulator/replay/command.h"
#include "protocols/http/request.h"
#include "protocols/stream_decoder.h"

namespace echoloop::replay {

struct WholeMessage {
    ByteView bytes;
    std::string name;  ///< "" for noise, and for bytes of no known family
    Command command;   ///< what it asks for, if it is a driver's
};

/// How a driver's bytes on a port are read.
struct DriverPort {
    const inspect::Family* family = nullptr;  ///< nullptr: each stretch of bytes is a request
    bool datagrams = false;
};

class MessageReader {
  public:
    using Each = std::function<void(const WholeMessage&)>;

    /// `family`: nullptr if it is not known; then requests of HTTP are understood, and of anything else each
    /// stretch of bytes counts as one message.
    /// `datagrams`: each is one message, and keeps its bounds.
    MessageReader(const inspect::Family* family, bool datagrams)
        : family_(family), datagrams_(datagrams), stream_(family) {}

    void add(ByteView bytes, const Each& each);
    /// Gives out what never became complete.
    void finish(const Each& each);
    /// Forgets it.
    void clear();

  private:
    void add_whole(ByteView bytes, const Each& each) const;
    void add_http(ByteView bytes, const Each& each);
    static inspect::StreamDecoder::Each decoded(const Each& each);

    const inspect::Family* family_;
    bool datagrams_;
    inspect::StreamDecoder stream_;
    std::optional<http::RequestReader> http_{};  ///< once a driver has begun to speak it
};

}  // namespace echoloop::replay
