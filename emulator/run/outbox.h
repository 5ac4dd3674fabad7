// What a device has said and its wires have not taken yet, by the time before which it must not go out.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "emulator/contract/device.h"

namespace echoloop {

/// A message, and the number of the ping that the device had heard last.
struct Mail {
    Send send;
    std::uint64_t ping;
    std::string remark;  ///< for a recording; "": none

    std::size_t memory() const;  ///< bytes that it takes in an outbox
};

/// Bounded: a driver may never read.
class Outbox {
  public:
    explicit Outbox(std::size_t ports) : bytes_for_(ports) {}

    /// It as it waits now. nullptr: there is no room, or what waits for a serial line of `line_rate` bit/s
    /// (0: it is none) would take longer than anybody waits for it.
    const Mail* post(Mail mail, double line_rate);
    bool empty() const { return mail_.empty(); }
    Time first_due() const { return mail_.begin()->first; }
    Mail take_first();
    void clear();
    /// A new driver gets nothing that was said before it came.
    void forget(std::size_t port);
    /// It is empty: what a flood took goes back to the system.
    void release_memory();

    std::size_t bytes_for(std::size_t port) const { return bytes_for_[port]; }
    std::size_t messages() const { return mail_.size(); }
    std::size_t bytes() const { return bytes_; }
    std::size_t most_messages() const { return most_messages_; }  ///< at once so far
    std::size_t most_bytes() const { return most_bytes_; }

  private:
    void count(const Mail& mail, bool comes);

    std::multimap<Time, Mail> mail_;  ///< by not_before; equal times keep their order
    std::size_t bytes_ = 0, memory_ = 0;
    std::size_t most_memory_ = 0;         ///< since it was empty
    std::vector<std::size_t> bytes_for_;  ///< by port
    std::size_t most_messages_ = 0, most_bytes_ = 0;
};

}  // namespace echoloop
