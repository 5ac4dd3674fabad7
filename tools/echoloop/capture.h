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
    std::uint64_t skipped = 0;   ///< no UDP over IPv4, or broken
    std::size_t incomplete = 0;  ///< datagrams of which fragments are missing
    std::string fault;           ///< why reading ended before the end of the file; empty: it did not
};

/// Calls `each` with the time (s since 1970) and content of every UDP datagram. Throws StartError (data) if
/// the file is no capture that can be read.
CaptureCounts read_capture(Input& input, const std::function<void(double, const Datagram&)>& each);

}  // namespace echoloop::cli
