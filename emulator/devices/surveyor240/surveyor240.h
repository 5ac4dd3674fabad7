// A Cerulean Surveyor 240-16 multibeam echosounder behind TCP or UDP. A pure state machine.
#pragma once

#include <optional>
#include <string_view>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/family/cerulean/common.h"
#include "emulator/devices/surveyor240/messages.h"

namespace echoloop::surveyor240 {

using ping_device::Peer;

class Surveyor240 final : public Device {
  public:
    Surveyor240(const Settings& settings, const std::vector<Endpoint>& endpoints);

    std::vector<Port> ports() const override { return ports_; }
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override;
    void line_rate(std::size_t port, double rate) override;
    DeviceCounters counters() const override;

  private:
    void obey(const ping::Frame& frame, const Peer& peer, Time now);
    void on(const ping::GeneralRequest& request, const Peer& peer, Time now);
    void on(const cerulean::surveyor::PingParameters& wanted, const Peer& peer, Time now);
    void on(const cerulean::surveyor::UtcResponse& response, const Peer& peer, Time now);
    void on(const cerulean::surveyor::SetNetInfo& info, const Peer& peer, Time now);

    /// nack(id, text) if there is a reason, else ack(id) where the option says so.
    void acknowledge(cerulean::Id id, std::optional<std::string_view> refusal, const Peer& peer);
    /// The message of a get id; false if there is none.
    bool send_message(std::uint16_t id, const Peer& peer);
    /// Least time from one ping to the next, as the host has set it.
    Time period() const;
    void transmit(Time now);
    /// Asks for the head's pose with a ping that sends nothing.
    void look_at_attitude(Time now);
    void send_points(const Echogram& echogram);
    bool is_attitude_fresh(Time now) const;
    /// What the periods ask for.
    void report(Time now);
    void reply(const cerulean::surveyor::Message& message, const Peer& to);
    void send(const cerulean::surveyor::Message& message, const Peer& to, Time when);
    /// To every host there is, a little behind what goes there already.
    void tell(const cerulean::surveyor::Message& message);

    void take_pose(const Echogram& echogram, Time at);
    /// The up vector as its accelerometers have it.
    std::array<float, 3> up(Time at) const;
    cerulean::surveyor::AttitudeReport attitude() const;
    cerulean::surveyor::WaterStats water() const;
    /// ms since 1970; 0 as long as no host has told.
    std::uint64_t utc(Time time) const;
    void greet(const Peer& peer, Time now);
    Actions take_actions();

    Settings settings_;
    std::vector<Endpoint> endpoints_;
    std::vector<Port> ports_;
    std::vector<std::size_t> pieces_;  ///< largest datagram, by port
    ping_device::Link link_;
    std::vector<std::optional<Address>> hosts_;  ///< who spoke last, by port
    std::vector<Time> free_from_;                ///< when the next message may follow, by port
    Parameters parameters_;
    Automatic automatic_;
    Plan plan_;  ///< of the ping under way, or of the last one
    cerulean::surveyor::AtofPointData atof_;
    cerulean::surveyor::YzPointData yz_;            ///< both of the last ping heard
    Pose pose_;                                     ///< of the last look or ping
    std::optional<Time> pose_at_;                   ///< when that was; nothing before the first
    std::optional<Time> looking_;                   ///< when the look began that is under way
    std::optional<std::uint64_t> utc_at_power_up_;  ///< ms since 1970
    std::uint32_t ping_ = 0;
    PingPacer pacer_{settings_.sensors, jitter::processor};
    Time transmitted_{};  ///< when the last ping went out
    Time next_attitude_ = Time::max(), next_utc_request_ = Time::max();
    Time next_water_ = Time::max();
    Actions actions_;  ///< of the call at hand
    Time now_{};       ///< of the call at hand
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::surveyor240
