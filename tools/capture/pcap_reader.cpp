#include "tools/capture/pcap_reader.h"

#include <pcap/pcap.h>

#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"
#include "emulator/scenario/value.h"
#include "tools/capture/packet.h"

namespace echoloop::capture {
namespace {

pcapng::WallTime time_of(const timeval& nano) {  // libpcap keeps nanoseconds in tv_usec at this precision
    return std::chrono::seconds(nano.tv_sec) + std::chrono::nanoseconds(nano.tv_usec);
}

/// Throws StartError if packets of that link cannot be read.
void require_known_link(int link, const std::string& name) {
    if (PacketReader::reads(link)) return;
    const char* link_name = pcap_datalink_val_to_name(link);
    throw StartError(Exit::data, name + ": packets of link type " +
                                     (link_name == nullptr ? std::to_string(link) : link_name) +
                                     " are not understood; capture on Ethernet, loopback or \"any\"");
}

}  // namespace

PcapReader::PcapReader(Input& input) {
    char error[PCAP_ERRBUF_SIZE] = "";
    std::FILE* stream = input.release();
    file_ = pcap_fopen_offline_with_tstamp_precision(stream, PCAP_TSTAMP_PRECISION_NANO, error);
    const auto name = scenario::in_quotes(input.name());
    if (file_ == nullptr) {
        std::fclose(stream);
        throw StartError(Exit::data, name + " is no capture that can be read: " + scenario::printable(error));
    }
    try {
        require_known_link(pcap_datalink(file_), name);
    } catch (...) {
        pcap_close(file_);
        throw;
    }
}

PcapReader::~PcapReader() { pcap_close(file_); }

std::optional<RawPacket> PcapReader::next() {
    pcap_pkthdr* header = nullptr;
    const std::uint8_t* bytes = nullptr;
    const int status = pcap_next_ex(file_, &header, &bytes);
    if (status == PCAP_ERROR) fault_ = scenario::printable(pcap_geterr(file_));
    if (status != 1) return {};
    return RawPacket{pcap_datalink(file_), "", time_of(header->ts), {}, {bytes, header->caplen},
                     header->len,          ""};
}

}  // namespace echoloop::capture
