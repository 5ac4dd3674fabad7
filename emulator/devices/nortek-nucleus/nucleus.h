// A Nortek Nucleus: commands and data by TCP or a serial line, data alone by a second TCP port. A pure state
// machine.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/family/doppler/measurement.h"
#include "emulator/devices/family/nortek/login.h"
#include "emulator/devices/nortek-nucleus/commands.h"
#include "protocols/nortek/messages.h"

namespace echoloop::nortek_nucleus {

/// What a port is for.
enum class Speech { commands, data, line };

/// Three slanted beams and one straight down, which is the last.
Shot make_shot(const doppler::Plan& plan, const Settings& settings, std::uint64_t number);

class Nucleus final : public Device {
  public:
    Nucleus(const Settings& settings, std::vector<Speech> ports);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    Actions located(std::span<const Located> places, Time now) override;
    void reconnected(std::size_t port) override;
    Actions connected(std::size_t port, Address peer, Time now) override;
    DeviceCounters counters() const override { return counters_; }

  private:
    struct Host {
        std::string text;
        nortek_console::Login login;  ///< who is in may command, and is told
    };
    void read_line(std::size_t port, const std::string& line, Time now);
    void start_or_stop(bool ran, Time now);
    void ping_if_due(Time now);
    void send_track(const doppler::Measured& measured, Time began);
    void send_altimeter(const Echogram& echogram, Time began);
    void tell(const nortek::Frame& frame);
    void say(std::size_t port, const std::string& text);
    nortek_console::Login login_of(Speech speech) const;
    std::int64_t clock(Time now) const;
    /// Fills in what all data begin with.
    template <class Data>
    Data data_of(Time at) const;
    Actions take_actions();

    Settings settings_;
    std::vector<Speech> speech_;
    State state_;
    std::map<std::size_t, Host> hosts_;  ///< by port
    std::int64_t clock_error_ = 0;

    doppler::Modes modes_;
    doppler::ModeSearch search_;
    PingPacer pacer_;
    doppler::Plan plan_;
    doppler::Measurement measurement_;
    double depth_ = 0;  ///< m
    Time next_attitude_ = Time::max();
    std::uint64_t shots_ = 0;
    Actions actions_;
    DeviceCounters counters_;
};

}  // namespace echoloop::nortek_nucleus
