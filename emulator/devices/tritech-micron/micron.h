// A Tritech Micron DST (or, by option, a MiniKing) behind its SeaNet serial line. A pure state machine.
#pragma once

#include <optional>

#include "emulator/devices/tritech-micron/boot.h"
#include "emulator/devices/tritech-micron/scan.h"
#include "emulator/devices/tritech-micron/settings.h"
#include "emulator/model.h"
#include "protocols/seanet/framer.h"
#include "protocols/seanet/messages.h"

namespace echoloop::micron {

class Micron final : public Device {
  public:
    explicit Micron(const Settings& settings);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override;
    DeviceCounters counters() const override;

  private:
    void obey(const seanet::Frame& frame, Time now);
    void on(const seanet::ReBoot&, Time now);
    void on(const seanet::SendVersion&, Time now);
    void on(const seanet::SendBBUser&, Time now);
    void on(const seanet::StopAlives&, Time now);
    void on(const seanet::SendData&, Time now);
    void on(const seanet::HeadCommand&, Time now);
    void on(const seanet::HeadCommandDual&, Time now);
    void on(const seanet::HeadCommandReverse&, Time now);
    void on(const seanet::HeadCommandGain&, Time now);

    void configure(const seanet::HeadParameters& parameters, Time now);
    void forget_requests();
    void send_alive(Time now);
    bool ready(Time now) const { return parameters_ && boot_.centred(now); }
    void ask_for_line(Time now);
    void begin_line(Time now);
    Time line_time(std::size_t frame_bytes) const;
    std::size_t reply_bytes(const Shot& shot) const;
    Time ping_time(const Shot& shot) const;
    seanet::HeadData head_data(const Echogram& echogram) const;
    template <class Message>
    void reply(const Message& message);
    Actions take_actions();

    Settings settings_;
    seanet::Framer framer_;
    Boot boot_;
    Scan scan_;
    std::optional<seanet::HeadParameters> parameters_;
    int lines_left_ = 0;        ///< of the request at hand, not yet begun
    int pending_requests_ = 0;  ///< surplus requests, merged or queued
    bool line_under_way_ = false;
    std::uint64_t ping_ = 0;  ///< number of the ping under way; echoes of others are stale
    Time line_free_{};        ///< when the last line has left the serial port
    Time next_line_ = Time::max();
    Actions actions_;  ///< of the call at hand
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::micron
