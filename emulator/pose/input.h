// Poses that come from outside while the emulator runs: lines of JSON, or MAVLink, over UDP, TCP, serial
// lines or standard input. What cannot be read is refused and counted, never guessed.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>

#include "emulator/clock/asio.h"
#include "emulator/clock/clock.h"
#include "emulator/contract/network.h"
#include "emulator/pose/lines.h"
#include "emulator/pose/mavlink_pose.h"
#include "emulator/pose/step_server.h"
#include "emulator/pose/whereabouts.h"
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
/// difference: of the last half to whole second, since a simulator's clock may run slower than ours. One that
/// goes back or leaps a second ahead is another clock.
class SenderClock {
  public:
    Time run_time(double sender_seconds, Time arrival);

  private:
    std::optional<Time> ahead_, before_;  ///< least run time minus the sender's: since `since_`, before that
    Time since_{};
    double last_ = 0;
};

/// Who is told where a thing of the scene is, by the name of its node.
using ObjectWhereabouts = std::map<std::string, Whereabouts*>;

class PoseInput final : public LineSource {
  public:
    /// `endpoint`: as in a scenario, or standard_input. `where` is told the poses; nullptr: nobody asks for
    /// them, and lines that tell some are refused. `steps`: of a stepped run, else nullptr. All outlive this.
    /// `origin`: of the world on the Earth, if that is known.
    /// Throws StartError if the endpoint cannot be opened.
    PoseInput(Clock& clock, const std::string& endpoint, std::span<const Network> peers, Whereabouts* where,
              StepServer* steps, ObjectWhereabouts objects = {}, std::optional<GeoPlace> origin = {});

    void start();
    void close() { transport_->close(); }
    PoseSummary summary() const;
    /// As it was given, with the number of a port that was left to the system.
    const std::string& endpoint() const { return endpoint_; }

    void take(const PoseText& text) override;
    Task<void> answer(std::string text, Address to, std::uint64_t connection) override;

  private:
    void received(ByteView bytes, Address from);
    void line(std::string_view text, Address from);
    void mavlink(ByteView bytes);
    void take_unstepped(const PoseText& text, Address from);
    void tell(const PoseMessage& message);
    void place_in_world(PoseText& read) const;
    std::string why_unknown(const std::string& object) const;
    void begin();
    void end();

    Clock& clock_;
    std::unique_ptr<Transport> transport_;
    std::string place_, endpoint_;
    bool comes_back_;  ///< who is at the other end, or another; standard input ends once
    bool datagrams_;
    Whereabouts* where_;
    ObjectWhereabouts objects_;
    StepServer* steps_;
    std::optional<GeoPlace> origin_;
    bool has_stepped_ = false;
    bool answering_ = false;  ///< that it is not stepped
    SenderClock sender_;
    std::uint64_t connection_ = 0;
    bool begun_ = false, speaks_mavlink_ = false;  ///< told by the first byte of a connection or datagram
    Lines lines_;
    mavlink::Framer framer_;
    MavlinkPose mavlink_pose_;
    PoseSummary summary_;
};

}  // namespace echoloop
