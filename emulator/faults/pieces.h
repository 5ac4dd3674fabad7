// Messages on their way to one end of a port, as the faults make them: lost, damaged, cut, doubled, late. A
// pure function of messages, times and chance; it sends nothing.
#pragma once

#include <deque>

#include "emulator/faults/faults.h"
#include "protocols/checksums.h"

namespace echoloop {

/// What goes over the wire in one write; no bytes: what is missing here.
struct Piece {
    Bytes bytes;
    Address to;
    std::vector<FaultEvent> events;  ///< offsets from the start of `bytes`
    Time due{};
    bool hang_up = false;  ///< the connection ends here
    double line_rate = 0;  ///< bit/s of these bytes on a serial line; 0: its own
};

/// What faults must know of the messages of a port.
struct MessageTraits {
    bool stream = true;                      ///< bytes in a row, not datagrams
    FindChecksums find_checksums = nullptr;  ///< nullptr: they have none
    double line_rate = 0;                    ///< bit/s of a serial line; 0: it is none
    bool several = false;                    ///< drivers on the port: these are the messages of one
};

class Pieces {
  public:
    Pieces(DeviceFaults& faults, FaultPlace place, const MessageTraits& traits);

    /// `line_rate`: of a piece.
    void add(ByteView bytes, Address to, Time now, double line_rate = 0);
    /// What befell the message that was added last, so far as is known yet.
    std::vector<FaultEvent> made_of_last() const;
    /// The connection is to end behind all that was added.
    void hang_up(Time now);
    /// One that nothing happens to took another way.
    void passed(std::size_t size);
    /// Nothing waits.
    bool idle() const { return queue_.empty() && merging_.empty() && overtaken_.empty(); }
    /// When take() has something; nothing if nothing waits.
    std::optional<Time> next_due() const;
    std::optional<Piece> take(Time now);
    /// No fault is left: what waits goes now.
    void hurry(Time now);
    /// Another driver is at the other end: what was on its way is gone.
    void clear();
    const FaultPlace& place() const { return place_; }
    /// Bytes of messages that did not fit the memory for what waits.
    std::uint64_t dropped_bytes() const { return dropped_bytes_; }

  private:
    /// A piece that waits for others.
    struct Waiting {
        Piece piece;
        Time until;            ///< it goes then at the latest
        std::int64_t wanted;   ///< how many it waits for
        std::ptrdiff_t event;  ///< among its events, the one that counts them
    };

    static bool happens(const AskedFault& asked, const Dice& dice);
    FaultEvent event(const AskedFault& asked) const;
    bool unplugged(Time now);
    bool lose(Piece& piece, Time now);
    std::vector<Piece> copies(Piece piece, Time now);
    void damage(Piece& piece, std::uint64_t copy, Time now);
    void garble(Piece& piece, const AskedFault& asked);
    void spoil_checksums(Piece& piece, const AskedFault& asked, std::uint64_t copy);
    void cut(Piece& piece, const AskedFault& asked, std::uint64_t copy);
    void flip(Piece& piece, const AskedFault& asked, std::uint64_t copy);
    void spoil_number(Piece& piece, const AskedFault& asked, std::uint64_t copy);
    void merge(Piece piece, Time now);
    void end_merging(Time now);
    void reorder(Piece piece, Time now);
    void let_overtaken_go(Time now);
    Waiting waiting(Piece piece, const AskedFault& asked, const char* counts, Time now) const;
    static std::int64_t& count(Waiting& waiting);
    void split(Piece piece, Time now);
    void schedule(Piece piece, Time now);
    void narrow(Piece piece, Time ready, Time now);
    void queue(Piece piece);
    /// Memory that all that waits takes.
    std::size_t held() const;
    /// What waits for others has waited long enough.
    void give_up_waiting(Time now);

    DeviceFaults& faults_;
    FaultPlace place_;
    MessageTraits traits_;
    std::uint64_t messages_ = 0;  ///< so far
    std::uint64_t message_ = 0;   ///< number of the one at hand
    std::uint64_t position_ = 0;  ///< of its first byte among all that came
    std::size_t last_size_ = 0;   ///< of the last one
    std::uint64_t scheduled_ = 0;
    std::deque<Waiting> merging_, overtaken_;
    std::deque<Piece> queue_;
    std::size_t first_new_ = 0;  ///< in the queue: what was added last
    std::size_t queued_memory_ = 0;
    std::uint64_t dropped_bytes_ = 0;
    Time last_due_{};   ///< of those in the queue: none overtakes another
    Time line_free_{};  ///< when the narrow line has carried all so far
};

}  // namespace echoloop
