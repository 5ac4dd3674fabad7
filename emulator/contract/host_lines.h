// The lines of several hosts at one port, so that half a message of one spoils no message of another.
#pragma once

#include <algorithm>
#include <cstdint>
#include <list>
#include <utility>

#include "emulator/contract/device.h"

namespace echoloop {

/// Who says something, and so who is answered: a host at a port; a byte stream has one.
struct Peer {
    std::size_t port = 0;
    Address address;
    friend auto operator<=>(const Peer&, const Peer&) = default;
};

/// A framer for each host. Whoever has said nothing for longest is forgotten when there are too many.
template <class Framer>
class HostLines {
  public:
    /// `fresh`: as it is for a host that has said nothing yet.
    explicit HostLines(Framer fresh = Framer()) : fresh_(std::move(fresh)) {}

    Framer& of(const Peer& host) {
        const auto found = std::ranges::find(lines_, host, &Line::host);
        if (found != lines_.end()) {
            lines_.splice(lines_.begin(), lines_, found);
        } else {
            if (lines_.size() == most_hosts) forget_last();
            lines_.push_front({host, fresh_});
        }
        return lines_.front().framer;
    }
    /// Half messages of all hosts at the port are worthless.
    void clear(std::size_t port) {
        for (Line& line : lines_)
            if (line.host.port == port) line.framer.clear();
    }
    std::uint64_t skipped_bytes() const {
        std::uint64_t sum = forgotten_;
        for (const Line& line : lines_) sum += line.framer.skipped_bytes();
        return sum;
    }

  private:
    static constexpr std::size_t most_hosts = 32;
    struct Line {
        Peer host;
        Framer framer;
    };
    void forget_last() {
        forgotten_ += lines_.back().framer.skipped_bytes() + lines_.back().framer.pending_bytes();
        lines_.pop_back();
    }

    Framer fresh_;
    std::list<Line> lines_;  ///< who spoke last comes first
    std::uint64_t forgotten_ = 0;
};

}  // namespace echoloop
