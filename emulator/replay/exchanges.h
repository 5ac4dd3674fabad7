// A capture as a conversation: each captured request with what followed it, and what the device says unasked
// in runs of its own. Built once; plays nothing.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "emulator/replay/player.h"
#include "emulator/replay/store.h"

namespace echoloop::replay {

/// Something the device said, its bytes in the store.
struct Kept {
    Time time{};
    std::size_t port = 0;
    std::size_t kind = 0;  ///< number of its port and name
    Store::Handle bytes;
    bool unasked = false;  ///< no single request explains it
};

/// A request and what the device said up to the next one.
struct Exchange {
    Time time{};
    std::size_t first = 0, end = 0;  ///< in said(): its answers, and unasked messages among them
    /// Where the unasked messages go on behind this request, in unasked(); empty: they rest.
    std::optional<std::size_t> unasked_after;
    bool starts_unasked = false;  ///< they rested before
    bool stops_unasked = false;
};

/// Requests that are all the same, in their order.
struct SameRequests {
    Command command;
    std::vector<std::size_t> exchanges;  ///< numbers in all()
    std::size_t next = 0;                ///< which of them a player takes next
};

class Exchanges {
  public:
    /// Reads the source to its end. Throws StartError (data) if it holds more than can be kept.
    explicit Exchanges(Source& source);

    const std::vector<Kept>& said() const { return said_; }
    const std::vector<Exchange>& all() const { return exchanges_; }
    Bytes bytes(const Kept& kept) const { return store_.read(kept.bytes); }

    /// The unasked messages in their order; numbers in said().
    const std::vector<std::size_t>& unasked() const { return unasked_; }
    /// First and last of the run that unasked()[i] belongs to: between two of its requests they come on and
    /// on.
    std::pair<std::size_t, std::size_t> run_of(std::size_t i) const;
    Time usual_gap() const { return usual_gap_; }  ///< between two of them
    /// True if they come before any request.
    bool begins_unasked() const { return begins_unasked_; }

    /// The captured requests that equal or come nearest to `command` on this port; nullptr if none asks for
    /// the same.
    SameRequests* nearest(std::size_t port, const Command& command);

  private:
    using Named = std::pair<std::size_t, std::string>;  ///< port and name or key

    void keep(const Said& said);
    void keep_request(const Said& said);
    std::vector<bool> unasked_kinds() const;
    void sort_out(const std::vector<bool>& unasked);
    void find_usual_gap();
    void find_runs();

    Store store_;
    std::vector<Kept> said_;
    std::vector<Exchange> exchanges_;
    std::vector<std::size_t> following_;  ///< for each of said_: number of the request before it, plus one
    std::vector<std::size_t> unasked_;
    std::vector<std::size_t> run_begins_;  ///< in unasked_
    Time usual_gap_{};
    bool begins_unasked_ = false;
    std::map<Named, std::size_t> kinds_;
    std::map<Named, std::map<std::vector<double>, SameRequests>> by_key_;
    std::size_t different_ = 0;  ///< requests in by_key_
};

}  // namespace echoloop::replay
