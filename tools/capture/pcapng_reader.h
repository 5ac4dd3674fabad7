// The packets of a pcapng file, block by block, whatever link each of its interfaces has (libpcap wants the
// same link for all). Takes any bytes: what breaks the format ends the reading with a reason. Opens nothing.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "emulator/capture/pcapng.h"

namespace echoloop::capture {

struct RawPacket {
    int link_type = 0;              ///< LINKTYPE_ number
    std::string interface;          ///< its name; "" if it has none
    pcapng::WallTime time{};        ///< since 1970
    std::optional<bool> sent;       ///< by the capturing side; empty: the capture does not say
    ByteView bytes;                 ///< until the next call
    std::size_t original_size = 0;  ///< on the wire
    std::string comment;
};

class PcapngReader {
  public:
    /// `read`: up to so many bytes, fewer only at the end of the file.
    using Read = std::function<Bytes(std::size_t)>;
    explicit PcapngReader(Read read) : read_(std::move(read)) {}

    /// Empty at the end or after a fault.
    std::optional<RawPacket> next();
    /// Why the reading ended before the end of the file; "": it did not.
    const std::string& fault() const { return fault_; }
    /// Who wrote the section at hand; "": it does not say.
    const std::string& application() const { return application_; }

  private:
    struct Interface {
        int link_type = 0;
        std::string name;
        std::uint64_t ticks_per_second = 1000000;
    };
    struct Block {
        std::uint32_t type = 0;
        Bytes body;
    };

    std::optional<Block> read_block();
    bool begin_section(Bytes& start);
    void describe_section(ByteView body);
    void add_interface(ByteView body);
    std::optional<RawPacket> enhanced(ByteView body);
    std::optional<RawPacket> simple(ByteView body);
    std::optional<RawPacket> fail(const std::string& why);
    template <class Each>
    void options(ByteView list, Each each) const;
    std::uint16_t u16(ByteView bytes, std::size_t at) const;
    std::uint32_t u32(ByteView bytes, std::size_t at) const;

    Read read_;
    bool big_endian_ = false;
    std::vector<Interface> interfaces_;
    Bytes body_;  ///< of the block at hand
    std::string fault_;
    std::string application_;
};

}  // namespace echoloop::capture
