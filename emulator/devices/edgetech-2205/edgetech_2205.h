// An EdgeTech 2205 side-scan: commands on one TCP port, data on another. A pure state machine.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/edgetech-2205/sonar_data.h"
#include "protocols/edgetech/codec.h"

namespace echoloop::edgetech_2205 {

class Edgetech2205 final : public Device {
  public:
    explicit Edgetech2205(const Settings& settings);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    Actions located(std::span<const Located> places, Time now) override;
    void reconnected(std::size_t port) override;
    DeviceCounters counters() const override;

  private:
    void obey(const edgetech::Message& message, Time now);
    bool set(const edgetech::Message& message, Time now);
    std::optional<edgetech::Body> get(const edgetech::Header& header, Time now) const;
    void answer(edgetech::Header header, edgetech::Command command, const edgetech::Body& body);
    void shut_down();

    bool pings_by_itself(std::size_t band) const;
    /// The band that pings next; nothing: none does.
    std::optional<std::size_t> next_band() const;
    void plan(Time now);
    void transmit(Time now);
    double unix_time(Time time) const { return settings_.unix_start + to_seconds(time) + clock_offset_; }
    Actions take_actions();

    Settings settings_;
    std::array<Subsystem, 2> bands_;  ///< low, high
    std::array<std::array<Weighting, 2>, 2> weightings_;
    survey::MotionUnit motion_;
    edgetech::Framer framer_{edgetech::longest_command};
    PingPacer pacer_{settings_.sensors, jitter::gate_array};
    std::size_t band_ = 1;                  ///< of the ping under way, or of the last one
    std::optional<std::size_t> coupled_{};  ///< that follows it
    Subsystem pinged_;                      ///< as it was when that ping went out
    std::uint64_t shots_ = 0;
    std::vector<edgetech::Message> heard_;  ///< sides that wait for their place
    double clock_offset_ = 0;               ///< s, of a clock that a host set
    survey::Reading reading_;               ///< of the last ping
    bool off_ = false;
    Actions actions_;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::edgetech_2205
