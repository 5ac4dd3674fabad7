// A Teledyne Reson 7k multibeam (SeaBat 7125 and its like): commands and records by TCP and UDP. A pure state
// machine.
#pragma once

#include <map>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/reson-7k/commands.h"
#include "emulator/devices/reson-7k/records.h"
#include "emulator/devices/reson-7k/ship_sensors.h"
#include "emulator/devices/reson-7k/subscribers.h"
#include "protocols/reson7k/framer.h"

namespace echoloop::reson7k_device {

class Reson7k final : public Device {
  public:
    /// `own`: where it listens, by TCP and UDP.
    Reson7k(const Settings& settings, Address own);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    Actions located(std::span<const Located> places, Time now) override;
    void reconnected(std::size_t) override {}
    Actions disconnected(std::size_t port, Address peer, Time now) override;
    DeviceCounters counters() const override;

  private:
    void hear_record(const reson7k::Record& record, const Peer& from, Time now);
    Refusal obey(const reson7k::RemoteControl& control, const Peer& from, bool named, Time now);
    Refusal subscribe(const reson7k::RemoteControl& control, const Peer& from);
    Refusal change_receiver(const reson7k::RemoteControl& control);
    Refusal read_types(const reson7k::RemoteControl& control, std::size_t at,
                       std::set<std::uint32_t>& types) const;
    Refusal check_request(const reson7k::RemoteControl& control) const;
    void answer_request(std::uint32_t type, const Peer& to, Time now);
    void plan_next_ping(Time now);
    void transmit(Time now);
    void publish(std::uint32_t type, const Echogram& echogram);
    /// To all who have subscribed to its type.
    void publish(const reson7k::Message& message, double unix_time);
    reson7k::SoundSpeed sound_speed(Time now) const;
    void tell_sound_speed(Time now);
    Time sensors_wake() const;
    void pace(Time now);
    void send(const reson7k::Message& message, const reson7k::RecordFrame& frame, const Peer& to);
    void send_record(ByteView record, const Peer& to);
    double unix_time(Time now) const { return settings_.unix_start + to_seconds(now); }
    Actions take_actions();

    Settings settings_;
    Address own_;
    Controls controls_;
    std::map<Address, reson7k::Framer> framers_;  ///< of the hosts on TCP
    Subscribers subscribers_;
    PingRecord ping_;  ///< the ping under way, or the last one
    PingPacer pacer_{settings_.sensors, jitter::gate_array};
    Time transmitted_{};      ///< when ping_ was
    Time datagrams_until_{};  ///< when the datagrams of the last ping are out
    std::uint16_t transmission_ = 0;
    ShipSensors sensors_{settings_.sensors, settings_.origin};
    Time next_sound_speed_{};
    Actions actions_;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::reson7k_device
