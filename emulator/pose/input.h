// Poses that come from outside while the emulator runs: lines of JSON over UDP or TCP. What cannot be read is
// refused and counted, never guessed.
#pragma once

#include <memory>
#include <string>

#include "emulator/asio.h"
#include "emulator/clock.h"
#include "emulator/pose/message.h"
#include "emulator/pose/track.h"
#include "emulator/transport/transport.h"

namespace echoloop {

struct PoseSummary {
    std::string place;  ///< the endpoint
    std::uint64_t accepted = 0, refused = 0;
    std::uint64_t jumps = 0;        ///< faster than anything under water moves
    std::uint64_t stale_pings = 0;  ///< pings with a pose too old to be trusted
    std::string last_refusal;
};

/// The sender's clock as run time. Messages are never early, so the one with the least delay tells the
/// difference; a clock that goes back or leaps a second ahead is another clock.
class SenderClock {
  public:
    Time run_time(double sender_seconds, Time arrival);

  private:
    std::optional<Time> ahead_;  ///< run time minus the sender's time
    double last_ = 0;
};

class PoseInput {
  public:
    /// `endpoint`: as in a scenario. `before`: where the vehicle is until the first message. Throws
    /// StartError if the endpoint cannot be opened.
    PoseInput(asio::io_context& io, const Clock& clock, const std::string& endpoint, const Pose& before);

    void start();
    void close() { transport_->close(); }
    /// For a ping at that time; counts the stale ones.
    Pose at(Time time);
    PoseSummary summary() const;

  private:
    void received(ByteView bytes);
    void line(std::string_view text);

    const Clock& clock_;
    std::unique_ptr<Transport> transport_;
    bool datagrams_;
    Pose before_;
    Track track_;
    SenderClock sender_;
    std::string waiting_;  ///< the beginning of a line
    bool overlong_ = false;
    PoseSummary summary_;
};

}  // namespace echoloop
