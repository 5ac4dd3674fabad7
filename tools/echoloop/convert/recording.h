// What a device said as a recording of its maker's own kind. A capture is read twice, since some files begin
// with what is known only at its end.
#pragma once

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/contract/device.h"

namespace echoloop::convert {

/// A whole message of a device, or of its host.
struct Heard {
    double time = 0;  ///< s, as captured
    ByteView bytes;
    std::string name;       ///< as its family calls it
    std::string comment{};  ///< of the packet that it began with, or of one since the message before
};

class Recording {
  public:
    Recording() = default;
    virtual ~Recording() = default;
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    /// What the host said to the device, between what that says; in both readings.
    virtual void asked(const Heard&) {}
    /// In the first reading.
    virtual void look(const Heard&) {}
    virtual void begin(std::ostream&) {}
    /// In the second.
    virtual void add(const Heard& heard, std::ostream& out) = 0;
    virtual void end(std::ostream&) {}

    std::size_t count() const { return count_; }  ///< of pings, records or messages that were written
    std::size_t lost() const { return lost_; }    ///< of which parts are missing

  protected:
    std::size_t count_ = 0, lost_ = 0;
};

/// A kind of file that this can write.
struct Format {
    std::string_view ending;    ///< ".kmall"
    std::string_view family;    ///< that it holds messages of; "" for any
    std::string_view contents;  ///< "KMALL datagrams"
    std::unique_ptr<Recording> (*make)();
    std::string_view holds = {};  ///< the message that a line must have to be chosen by itself; "" for any
};

/// Those of that ending, in upper or lower case: one for each family that such files may hold.
std::vector<Format> formats_of(const std::filesystem::path& file);
/// ".kmall, .s7k, ..."
std::string endings();

std::unique_ptr<Recording> make_kmall();
std::unique_ptr<Recording> make_s7k();
std::unique_ptr<Recording> make_svlog();
std::unique_ptr<Recording> make_ping_viewer_log();
std::unique_ptr<Recording> make_aris();
std::unique_ptr<Recording> make_jsf();
std::unique_ptr<Recording> make_xtf();
std::unique_ptr<Recording> make_xtf_872();

inline void put(std::ostream& out, ByteView bytes) {
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace echoloop::convert
