// A Teledyne Wayfinder on its line: commands with their answers, and a packet of data for each ping. A pure
// state machine.
#pragma once

#include "emulator/contract/model.h"
#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/dvl-wayfinder/commands.h"
#include "emulator/devices/family/doppler/measurement.h"
#include "protocols/wayfinder/codec.h"

namespace echoloop::dvl_wayfinder {

class Dvl final : public Device {
  public:
    explicit Dvl(const Settings& settings);

    std::vector<Port> ports() const override { return {{"line", Port::Kind::stream, {}, false}}; }
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t) override { framer_.clear(); }
    DeviceCounters counters() const override;

  private:
    void hear_packet(ByteView bytes, Time now);
    /// Behind a command, from what the device was before it.
    void follow(const State& before, bool trigger, Time now);
    void choose_modes();
    void ping_if_due(Time now);
    double period_of(double altitude) const;
    void say(wayfinder::Kind kind, const wayfinder::Body& body, double rate);
    /// bit/s at which it speaks; 0: the line's own.
    double rate() const;
    std::int64_t clock(Time now) const;
    Actions take_actions();

    Settings settings_;
    State state_;
    wayfinder::Framer framer_;
    std::int64_t clock_error_ = 0;

    doppler::Modes modes_;
    doppler::ModeSearch search_;
    PingPacer pacer_;
    doppler::Plan plan_;
    double speed_ = 0;  ///< m/s, of sound, that the last ping was sent with
    doppler::Measurement measurement_;
    double altitude_ = 0;  ///< m; 0: no bottom
    std::uint64_t shots_ = 0;
    Actions actions_;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::dvl_wayfinder
