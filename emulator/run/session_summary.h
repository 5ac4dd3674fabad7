// What a session did, and the names that its figures have in JSON. Data only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/contract/device.h"

namespace echoloop {

/// What a session did, for the end of a run.
struct SessionSummary {
    std::string name;
    bool is_sonar = true;  ///< its model sends pings
    DeviceCounters device;
    std::uint64_t pings = 0;       ///< echograms delivered
    std::uint64_t late_pings = 0;  ///< delivered more than a millisecond after they were due
    /// Of those, by cause: the echogram was what they waited for, or else the machine woke this program too
    /// late.
    std::uint64_t late_renderings = 0, late_wakings = 0;
    /// Rendering did not keep up (overload.h): late echoes of the ping before were left out, and of those,
    /// drawn with fewer pixels.
    std::uint64_t spared_pings = 0, coarse_pings = 0;
    /// Of all pings; the last is what 99 of 100 do not exceed.
    Time worst_lateness{}, median_lateness{}, p99_lateness{};
    /// Messages that did not fit the outbox, or what is kept for a driver that does not read.
    std::uint64_t dropped = 0;
    std::size_t most_waiting = 0, most_waiting_bytes = 0;  ///< messages in the outbox at once
    std::size_t waiting = 0, waiting_bytes = 0;            ///< the same, now
    std::uint64_t bytes_in = 0, bytes_out = 0;
    std::uint64_t messages_out = 0;      ///< of which any byte reached a driver or the network
    std::uint64_t empty_datagrams = 0;   ///< came in and mean nothing: no serial line carries them
    std::uint64_t bytes_lost = 0;        ///< a driver was there and did not take them
    std::uint64_t targets_refused = 0;   ///< datagrams not sent, since their targets are none of the peers
    std::vector<std::string> connected;  ///< drivers, now: addresses, and links of ptys that are open
};

/// Calls `visit(name, value, while_running)` with each figure in the order of JSON; times are in s.
/// `while_running`: somebody who asks during the run is told of it, too.
template <class Visit>
void for_each_figure(const SessionSummary& s, const Visit& visit) {
    visit("pings", s.pings, true);
    visit("late_pings", s.late_pings, true);
    visit("late_renderings", s.late_renderings, false);
    visit("late_wakings", s.late_wakings, false);
    visit("spared_pings", s.spared_pings, true);
    visit("coarse_pings", s.coarse_pings, true);
    visit("worst_lateness_s", to_seconds(s.worst_lateness), false);
    visit("median_lateness_s", to_seconds(s.median_lateness), false);
    visit("p99_lateness_s", to_seconds(s.p99_lateness), false);
    visit("most_waiting", s.most_waiting, false);
    visit("most_waiting_bytes", s.most_waiting_bytes, false);
    visit("messages", s.device.messages, true);
    visit("rejected", s.device.rejected, true);
    visit("skipped_bytes", s.device.skipped_bytes, true);
    visit("dropped", s.dropped, true);
    visit("bytes_in", s.bytes_in, true);
    visit("bytes_out", s.bytes_out, true);
    visit("messages_out", s.messages_out, true);
    visit("empty_datagrams", s.empty_datagrams, true);
    visit("bytes_lost", s.bytes_lost, false);
    visit("targets_refused", s.targets_refused, true);
}

}  // namespace echoloop
