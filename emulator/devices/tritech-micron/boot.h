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
    /// Parameters came: the next alive comes at once, but not in bursts, since one host repeats its
    /// parameters on every alive that is not to its liking.
    void hasten_alive(Time now);
    /// The alive of this moment; the next is due a second later.
    seanet::Alive alive(Time now, std::uint16_t position);

  private:
    Time first_alive() const;
    std::uint8_t head_inf(Time now) const;
    bool no_params(Time now) const { return !has_parameters_ || acknowledging_ || !centred(now); }

    const Settings& settings_;
    Time start_{}, centred_at_{}, next_alive_{}, last_alive_{};
    Time clock_offset_{};  ///< head time minus run time
    bool has_parameters_ = false;
    bool acknowledging_ =
        false;  ///< the next alive still says NoParams, with SentCfg: the vendor's acknowledgement
    bool sent_cfg_ = false;
    bool stopped_ = false;
};

}  // namespace echoloop::micron
