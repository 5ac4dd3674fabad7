// Makers' recordings that hold a device's messages in records of their own, read record by record. A damaged
// stretch is passed over to the next good record, and counted. Takes any bytes.
#pragma once

#include <deque>

#include "tools/capture/capture.h"

namespace echoloop::capture {

/// What stands at one place of the file.
struct Entry {
    std::size_t size = 0;       ///< B of the file; 0: more of them are needed
    bool damaged = false;       ///< no record begins here
    double time = 0;            ///< s since 1970
    std::vector<Bytes> said{};  ///< messages of the device; none: the record holds something else
    double spacing = 0;         ///< s between them
    std::string clock{};        ///< as in CaptureEvent
};

/// One kind of file.
class Container {
  public:
    Container() = default;
    virtual ~Container() = default;
    Container(const Container&) = delete;
    Container& operator=(const Container&) = delete;

    /// What `pending`, not empty, begins with. `last`: the file ends behind it, so that what is not whole is
    /// damaged.
    virtual Entry look(ByteView pending, bool last) = 0;
    /// Of a file in which no record held a message: what it holds instead; "": nothing is known.
    virtual std::string others() const { return {}; }
};

/// Where in `bytes` `begins(rest)` is true, from byte 1 on. Else what to pass over so that a beginning of up
/// to `longest` bytes stays whole; all if this is the last of the file.
template <class Begins>
std::size_t distance_to_next(ByteView bytes, bool last, std::size_t longest, Begins begins) {
    for (std::size_t at = 1; at < bytes.size(); ++at)
        if (begins(bytes.subspan(at))) return at;
    return last || bytes.size() <= longest ? bytes.size() : bytes.size() - longest;
}

/// Whether the first `size` bytes look like a record but are none, because bytes of it were lost: what is
/// behind them is no record's beginning, and one begins among them. Empty: more of the file must be seen to
/// tell.
template <class Begins>
std::optional<std::size_t> lost_bytes_before(ByteView pending, std::size_t size, bool last,
                                             std::size_t beginning, Begins begins) {
    if (pending.size() < size + beginning && !last) return {};
    if (pending.size() == size || begins(pending.subspan(size))) return 0;
    const std::size_t next = distance_to_next(pending, last, beginning, begins);
    return next < size ? next : 0;
}

class ContainerFile final : public CaptureReader {
  public:
    enum class Speech { stream, datagrams };

    /// `line`: a name for the device's port. `begin`: B of the file that were read before.
    ContainerFile(Input& input, std::unique_ptr<Container> container, std::string line, Speech speech,
                  std::uint64_t begin = 0);

    /// Throws StartError (data) behind a file of which only its Container's others() are known.
    std::optional<CaptureEvent> next() override;
    CaptureCounts counts() const override { return counts_; }
    /// Datagrams are those of a port of a device.
    bool of_ports() const override { return speech_ == Speech::datagrams; }

  private:
    bool read_more();
    void keep(Entry entry);
    void end();
    void refuse_others() const;

    Input& input_;
    std::unique_ptr<Container> container_;
    std::string line_;
    Speech speech_;
    Bytes pending_;
    std::size_t at_ = 0;   ///< of pending_, done
    std::uint64_t place_;  ///< of pending_[at_] in the file
    bool ended_ = false;
    std::uint64_t damaged_ = 0;  ///< B without a record just before place_
    std::deque<CaptureEvent> waiting_;
    CaptureCounts counts_;
};

}  // namespace echoloop::capture
