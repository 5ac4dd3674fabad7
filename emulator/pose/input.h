// Poses that come from outside while the emulator runs: lines of JSON, or MAVLink, over UDP or TCP. What
// cannot be read is refused and counted, never guessed.
#pragma once

#include <memory>
#include <string>

#include "emulator/asio.h"
#include "emulator/clock.h"
#include "emulator/pose/mavlink_pose.h"
#include "emulator/pose/message.h"
#include "emulator/pose/track.h"
#include "emulator/transport/transport.h"
#include "protocols/mavlink/framer.h"

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
    PoseInput(Clock& clock, const std::string& endpoint, const Pose& before);

    void start();
    void close() { transport_->close(); }
    /// For a ping at that time; counts the stale ones.
    Pose at(Time time);
    PoseSummary summary() const;

  private:
    void received(ByteView bytes);
    void text(ByteView bytes);
    void line(std::string_view text);
    void mavlink(ByteView bytes);
    void take(const PoseText& read);
    void begin();

    Clock& clock_;
    std::unique_ptr<Transport> transport_;
    std::string place_;
    bool datagrams_;
    Pose before_;
    Track positions_, attitudes_;  ///< apart, since some messages tell one of them only
    SenderClock sender_;
    bool begun_ = false, speaks_mavlink_ = false;  ///< told by the first byte of a connection or datagram
    std::string waiting_;                          ///< the beginning of a line
    bool overlong_ = false;
    mavlink::Framer framer_;
    MavlinkPose mavlink_pose_;
    PoseSummary summary_;
};

}  // namespace echoloop
