// The messages of a capture, each direction decoded by itself. In bounded memory, whatever the bytes are.
#pragma once

#include <functional>
#include <map>
#include <tuple>

#include "protocols/inspect.h"
#include "protocols/stream_decoder.h"
#include "tools/capture/capture.h"

namespace echoloop::capture {

/// One direction of a serial line, of a connection, or of datagrams.
struct Way {
    std::string line{};  ///< name of a serial line's interface, or of the device in a maker's recording
    bool sent = false;   ///< by the capturing side, if there are no addresses
    Address from{}, to{};
    bool is_serial() const { return from.port == 0 && to.port == 0; }
    friend auto operator<=>(const Way&, const Way&) = default;
};

/// Whose message it is, and where it stands: in the packet that completed it.
struct MessageOrigin {
    Way way;
    const inspect::Family* family = nullptr;  ///< nullptr: not known
    double time = 0;                          ///< s, as the capture counts
    std::uint64_t packet = 0;                 ///< number of the packet, from 1
};

class MessageSorter {
  public:
    using Each = std::function<void(const MessageOrigin&, const inspect::Message&)>;
    /// `family`: nullptr to guess it, for each direction by itself.
    MessageSorter(const inspect::Family* family, Each each) : family_(family), each_(std::move(each)) {}

    void add(const CaptureEvent& event);
    /// Gives out what never became complete.
    void finish();

  private:
    struct Stream {
        inspect::StreamDecoder decoder;
        MessageOrigin last;  ///< of the last bytes
    };
    using Streams = std::map<Way, Stream>;

    void add(const MessageOrigin& origin, const StreamPiece& piece);
    void add(const MessageOrigin& origin, const Datagram& datagram);
    Bytes whole_of(const inspect::Family& family, const Way& way, const Bytes& datagram);
    void continue_with(Streams& streams, const MessageOrigin& origin, ByteView bytes);
    void end(Streams& streams, const Way& way);
    inspect::StreamDecoder::Each giver(const MessageOrigin& origin) const;

    const inspect::Family* family_;
    Each each_;
    Streams streams_, datagrams_;
    std::map<Way, Bytes> joining_;  ///< parts of divided datagrams
};

}  // namespace echoloop::capture
