// A Water Linked DVL: JSON by TCP, the serial protocol, PD6 and PD4 by TCP, HTTP. A pure state machine.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "emulator/contract/host_lines.h"
#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/family/waterlinked/http_hosts.h"
#include "emulator/devices/waterlinked-dvl/commands.h"
#include "emulator/devices/waterlinked-dvl/host_text.h"
#include "emulator/devices/waterlinked-dvl/pages.h"
#include "emulator/devices/waterlinked-dvl/report.h"

namespace echoloop::waterlinked_dvl {

/// What a port speaks.
enum class Speech { json, http, pd6, pd4, serial };

struct Wiring {
    std::vector<Speech> ports;
    std::vector<std::uint16_t> numbers;  ///< of TCP ports, in the same order; 0: a line
    std::string address;                 ///< its own, "" without network
};

class Dvl final : public Device {
  public:
    Dvl(const Settings& settings, const Wiring& wiring);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override;
    Actions connected(std::size_t port, Address peer, Time now) override;
    Actions disconnected(std::size_t port, Address peer, Time now) override;
    DeviceCounters counters() const override;

  private:
    bool boots(Time now) const { return now < boot_end_; }
    bool pings() const;
    bool sends_water() const { return state_.configuration.range_mode.water; }
    void restart_search();
    Mode mode_of_next(Time now);
    void plan(Time now);
    void ping_if_due(Time now);

    void read_documents(Peer host, Time now);
    void read_lines(Peer host, Time now);
    void obey(Answer answer, Peer host, Time now);
    void after_command(const Configuration& before, Time now);
    void expire(Time now);
    void read_pages(const Received& data, Time now);
    std::vector<OutputRow> outputs() const;

    void send_report(const VelocityReport& report);
    void send_position(Time now);
    void tell(Speech speech, const std::string& text);
    void tell(Speech speech, const Bytes& bytes);
    double inside(Time now) const;
    std::int64_t unix_us(Time at) const;
    Actions take_actions(Time now);

    Settings settings_;
    Wiring wiring_;
    State state_;
    Time boot_end_{};
    std::map<Peer, HostText> hosts_;
    std::map<std::size_t, std::size_t> clients_;  ///< how many, by port
    waterlinked_family::HttpHosts web_;

    Modes modes_;
    doppler::ModeSearch search_;
    PingPacer pacer_;
    doppler::Plan plan_;
    bool triggered_ = false;  ///< the ping under way was asked for
    std::uint64_t shots_ = 0;
    doppler::Measurement measurement_;
    Time last_report_{};
    Time next_position_ = Time::max(), reset_at_ = Time::max(), calibrated_at_ = Time::max();
    Time next_empty_ = Time::max();  ///< report while acoustics are off
    Actions actions_;
    DeviceCounters counters_;
};

}  // namespace echoloop::waterlinked_dvl
