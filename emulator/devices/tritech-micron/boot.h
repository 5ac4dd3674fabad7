// Power-up of a Micron and its once-a-second mtAlive: re-centring, then waiting for parameters. Knows no
// echoes.
#pragma once

#include "emulator/device.h"
#include "emulator/devices/tritech-micron/settings.h"

namespace echoloop::micron {

class Boot {
  public:
    explicit Boot(const Settings& settings) : settings_(settings) {}

    /// Power-up or mtReBoot: everything forgotten, re-centring begins.
    void restart(Time now);
    bool booted(Time now) const { return now >= first_alive(); }
    bool centred(Time now) const { return now >= centred_at_; }
    Time centred_at() const { return centred_at_; }

    void head_command();
    void bb_user_sent();
    void stop_alives() { stopped_ = true; }
    void set_clock(std::uint32_t milliseconds, Time now);
    /// A line was requested and served: the line is busy, the next alive is a second away.
    void line_served(Time now);

    /// When the next alive is due; Time::max() if never.
    Time next_alive() const { return stopped_ ? Time::max() : next_alive_; }
    /// True if alives are sent at all and the head has come up.
    bool may_speak(Time now) const { return !stopped_ && booted(now); }
    /// The alive of this moment. Counts as sent.
    seanet::Alive alive(Time now, std::uint16_t position);
    /// The one-second beat went by.
    void beat(Time now);

  private:
    Time first_alive() const;
    std::uint8_t head_inf(Time now) const;
    bool no_params(Time now) const { return !has_parameters_ || acknowledging_ || !centred(now); }

    const Settings& settings_;
    Time start_{}, centred_at_{}, next_alive_{};
    Time clock_offset_{};  ///< head time minus run time
    bool has_parameters_ = false;
    bool acknowledging_ =
        false;  ///< the next alive still says NoParams, with SentCfg: the vendor's acknowledgement
    bool sent_cfg_ = false;
    bool stopped_ = false;
};

}  // namespace echoloop::micron
