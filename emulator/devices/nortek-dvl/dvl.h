// A Nortek DVL: commands and data by TCP or a serial line, data alone by TCP and UDP. A pure state machine.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/family/doppler/measurement.h"
#include "emulator/devices/nortek-dvl/commands.h"
#include "emulator/devices/nortek-dvl/track.h"

namespace echoloop::nortek_dvl {

/// What a port is for: commands and data behind a login; all data; those that are text; a serial line, which
/// does both without a login; datagrams.
enum class Speech { commands, data, text, line, datagrams };

struct Outlet {
    Speech speech = Speech::line;
    Port port;
    Address host;  ///< of datagrams
};

class Dvl final : public Device {
  public:
    Dvl(const Settings& settings, std::vector<Outlet> outlets);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override;
    Actions connected(std::size_t port, Address peer, Time now) override;
    DeviceCounters counters() const override { return counters_; }

  private:
    struct Host {
        std::string text;
        char last = 0;
        nortek_console::Login login;  ///< who is in may command, and is told
    };
    nortek_console::Login login_of(Speech speech) const;
    void hear_byte(std::size_t port, char c, Time now);
    void read_line(std::size_t port, const std::string& line, Time now);
    void take_break(std::size_t port, Time now);
    void follow_mode(Mode before, Time now);
    void start_measuring(Time now);
    void stop_measuring();
    void ping_if_due(Time now);
    Time edge_after(Time now) const;
    double speed_at(Time now) const;
    void report(const Echogram& echogram, Time began);
    void tell(const nortek::DvlTrack& track, bool water);
    void tell(const Bytes& bytes, bool is_text);
    void say(std::size_t port, const std::string& text, Address to = {});
    std::int64_t clock(Time now) const;
    Actions take_actions();

    Settings settings_;
    std::vector<Outlet> outlets_;
    State state_;
    std::map<std::size_t, Host> hosts_;  ///< by port
    std::int64_t clock_error_ = 0;

    Settings live_;  ///< with what a host has set
    doppler::Modes modes_;
    doppler::ModeSearch search_;
    PingPacer pacer_;
    doppler::Plan plan_;
    doppler::Measurement measurement_;
    double speed_ = 1500;  ///< m/s, which it assumes of the ping under way
    double depth_ = 0;     ///< m
    Time next_edge_ = Time::max(), asked_until_ = Time::max();
    std::uint64_t shots_ = 0;
    Actions actions_;
    DeviceCounters counters_;
};

}  // namespace echoloop::nortek_dvl
