// A capture file, or a plain file of bytes, read from the front without holding it in memory. The only user
// of libpcap.
#pragma once

#include <cstdio>
#include <functional>
#include <string>

#include "tools/echoloop/packet.h"

namespace echoloop::cli {

/// A file or standard input ("-") that knows its first bytes before they are read.
class Input {
  public:
    /// Throws StartError (no_input, no_permission) unless it is a regular file or "-".
    explicit Input(const std::string& name);
    ~Input();
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;

    bool is_capture();  ///< begins as pcap or pcapng files do
    /// Up to `count` bytes that read() will give again.
    const Bytes& peek(std::size_t count);
    /// Up to `count` bytes; fewer only at the end. Throws StartError (io).
    Bytes read(std::size_t count);
    /// Gives the stream away, from the first byte on; for libpcap, which closes it.
    std::FILE* release();
    const std::string& name() const { return name_; }

  private:
    std::string name_;
    std::FILE* file_ = nullptr;
    Bytes head_;  ///< bytes that were read ahead
};

struct CaptureCounts {
    std::uint64_t packets = 0;
    std::uint64_t skipped = 0;   ///< no UDP or TCP over IPv4, no serial line, or broken
    std::size_t incomplete = 0;  ///< datagrams of which fragments are missing
    std::string fault;           ///< why reading ended before the end of the file; empty: it did not
};

/// Bytes that come next on a serial line or in one direction of a TCP connection.
struct StreamPiece {
    std::string line;   ///< name of a serial line's interface; "" for TCP
    bool sent = false;  ///< serial: by the capturing side
    Address from, to;   ///< TCP
    ByteView bytes;
    bool gap = false;  ///< the capture lacks bytes before these
};

/// What a capture holds, in its order; times in s since 1970.
struct CaptureEvents {
    std::function<void(double, const Datagram&)> datagram;
    std::function<void(double, const StreamPiece&)> stream;
};

/// pcap files through libpcap; pcapng files with interfaces of any link. Throws StartError (data) if the file
/// is no capture that can be read.
CaptureCounts read_capture(Input& input, const CaptureEvents& events);

}  // namespace echoloop::cli
