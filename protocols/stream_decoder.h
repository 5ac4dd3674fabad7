// Decodes one direction of a byte stream as its bytes come, in bounded memory. Knows no family; the caller
// names one or it is guessed. A port on which HTTP is spoken instead is told by its first bytes.
#pragma once

#include <functional>

#include "protocols/inspect.h"

namespace echoloop::inspect {

class StreamDecoder {
  public:
    /// `family` is nullptr where it was not known; `bytes` are those of the message.
    using Each = std::function<void(const Family* family, const Message& message, wire::ByteView bytes)>;

    /// `family`: nullptr to guess it from the first bytes that tell.
    explicit StreamDecoder(const Family* family = nullptr) : family_(family) {}

    /// Calls `each` for every message that is complete and for noise before it; offsets are those of the
    /// stream.
    void add(wire::ByteView bytes, const Each& each);
    /// Gives out what never became complete, and begins anew: bytes are missing, or nothing more comes.
    void finish(const Each& each);

  private:
    void decode(bool last, const Each& each);
    bool decode_http(const Each& each);
    void drop(std::size_t count);

    const Family* family_;
    wire::Bytes waiting_;
    std::size_t tried_ = 0;   ///< bytes of waiting_ that were decoded in vain
    std::size_t offset_ = 0;  ///< of waiting_ in the stream
};

}  // namespace echoloop::inspect
