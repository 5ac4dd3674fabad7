// The packets of a pcap file, in either byte order and resolution. The only user of libpcap.
#pragma once

#include "tools/capture/input.h"
#include "tools/capture/pcapng_reader.h"

struct pcap;

namespace echoloop::capture {

class PcapReader {
  public:
    /// Takes the rest of `input`. Throws StartError (data) if it is no such file, or of a link that cannot be
    /// read.
    explicit PcapReader(Input& input);
    ~PcapReader();
    PcapReader(const PcapReader&) = delete;
    PcapReader& operator=(const PcapReader&) = delete;

    /// Empty at the end or after a fault.
    std::optional<RawPacket> next();
    /// Why the reading ended before the end of the file; "": it did not.
    const std::string& fault() const { return fault_; }

  private:
    pcap* file_;
    std::string fault_;
};

}  // namespace echoloop::capture
