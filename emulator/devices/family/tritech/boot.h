// Power-up of a SeaNet head and its once-a-second mtAlive: re-centring, then waiting for parameters; and the
// motor, which may fall asleep. Knows no echoes.
#pragma once

#include <string>

#include "emulator/contract/device.h"
#include "protocols/seanet/messages.h"

namespace echoloop::tritech {

/// What the specification leaves open about the start.
struct BootRules {
    double first_alive = 1;            ///< s after power-up or reboot
    int recentring_alives = 3;         ///< alives with InCentre after a reboot
    std::vector<std::uint8_t> homing;  ///< their HeadInf; the last one repeats
    bool alives_while_scanning = false;
    std::string sent_cfg_by = "both";
    double motor_off_after = 0;  ///< s without a ping; 0: never
    double motor_start = 1;      ///< s from power-down to the next ping
};

class Boot {
  public:
    explicit Boot(BootRules rules) : rules_(std::move(rules)) {}

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

    /// When the motor can move for a ping that is asked for now. A motor that sleeps is woken.
    Time wake_motor(Time now);

    /// When the next alive is due; Time::max() if never.
    Time next_alive() const { return stopped_ ? Time::max() : next_alive_; }
    /// Parameters came: the next alive comes at once, but not in bursts, since one host repeats its
    /// parameters on every alive that is not to its liking.
    void hasten_alive(Time now);
    /// The alive of this moment; the next is due a second later.
    seanet::Alive alive(Time now, std::uint16_t position);

  private:
    Time first_alive() const;
    bool motor_on(Time now) const;
    std::uint8_t motion(Time now) const;
    std::uint8_t head_inf(Time now) const;
    bool no_params(Time now) const { return !has_parameters_ || acknowledging_ || !centred(now); }

    BootRules rules_;
    Time start_{}, centred_at_{}, next_alive_{}, last_alive_{};
    Time motor_used_{};    ///< last known use of the motor
    Time motor_ready_{};   ///< when it was or will be awake
    Time clock_offset_{};  ///< head time minus run time
    bool has_parameters_ = false;
    bool acknowledging_ =
        false;  ///< the next alive still says NoParams, with SentCfg: the vendor's acknowledgement
    bool sent_cfg_ = false;
    bool stopped_ = false;
};

}  // namespace echoloop::tritech
