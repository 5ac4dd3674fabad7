#include "emulator/devices/family/tritech/boot.h"

#include <algorithm>

namespace echoloop::tritech {
namespace {

using namespace std::chrono_literals;
constexpr Time beat_time = 1s, least_gap = 200ms;

}  // namespace

Time Boot::first_alive() const { return start_ + from_seconds(rules_.first_alive); }

void Boot::restart(Time now) {
    start_ = now;
    last_alive_ = now - beat_time;
    next_alive_ = first_alive();
    // Half a beat before the first alive that says Centred, so that a late timer changes nothing.
    centred_at_ = rules_.recentring_alives == 0
                      ? now
                      : first_alive() + rules_.recentring_alives * beat_time - beat_time / 2;
    motor_used_ = motor_ready_ = centred_at_;
    clock_offset_ = -now;
    has_parameters_ = acknowledging_ = sent_cfg_ = stopped_ = false;
}

void Boot::head_command() {
    if (!has_parameters_) acknowledging_ = true;
    has_parameters_ = true;
    if (rules_.sent_cfg_by != "bb-user") sent_cfg_ = true;
}

void Boot::bb_user_sent() {
    if (rules_.sent_cfg_by != "head-command") sent_cfg_ = true;
}

void Boot::set_clock(std::uint32_t milliseconds, Time now) {
    if (milliseconds != 0) clock_offset_ = std::chrono::milliseconds(milliseconds) - now;
}

void Boot::line_served(Time now) {
    motor_used_ = std::max(motor_used_, now);
    if (!rules_.alives_while_scanning) next_alive_ = now + beat_time;
}

bool Boot::motor_on(Time now) const {
    return rules_.motor_off_after <= 0 || now <= motor_used_ + from_seconds(rules_.motor_off_after);
}

Time Boot::wake_motor(Time now) {
    if (!motor_on(now)) motor_ready_ = now + from_seconds(rules_.motor_start);
    motor_used_ = std::max({motor_used_, motor_ready_, now});
    return std::max(now, motor_ready_);
}

void Boot::hasten_alive(Time now) {
    if (booted(now)) next_alive_ = std::min(next_alive_, std::max(now, last_alive_ + least_gap));
}

/// HeadInf less what it says of parameters.
std::uint8_t Boot::motion(Time now) const {
    namespace bits = seanet::head_inf;
    if (centred(now)) return bits::centred | (motor_on(now) ? bits::motor_on : std::uint8_t{0});
    const auto beat = now < first_alive() ? 0 : (now - first_alive() + beat_time / 2) / beat_time;
    const auto last = static_cast<std::ptrdiff_t>(rules_.homing.size()) - 1;
    if (last < 0) return bits::in_centre | bits::motoring | bits::motor_on;
    return rules_.homing[static_cast<std::size_t>(std::min<std::ptrdiff_t>(beat, last))] &
           static_cast<std::uint8_t>(~(bits::no_params | bits::sent_cfg));
}

std::uint8_t Boot::head_inf(Time now) const {
    namespace bits = seanet::head_inf;
    std::uint8_t inf = motion(now);
    if (no_params(now)) inf |= bits::no_params;
    if (sent_cfg_) inf |= bits::sent_cfg;
    return inf;
}

seanet::Alive Boot::alive(Time now, std::uint16_t position) {
    seanet::Alive alive;
    alive.will_send = no_params(now) ? 0x80 : 0x00;
    const auto head_time = std::chrono::duration_cast<std::chrono::milliseconds>(now + clock_offset_);
    alive.time_ms = static_cast<std::uint32_t>(head_time.count());
    alive.motor_position = position;
    alive.head_inf = head_inf(now);
    if (centred(now)) acknowledging_ = false;
    last_alive_ = now;
    next_alive_ = std::max(next_alive_ + beat_time, now + beat_time / 2);  // a stalled run does not catch up
    return alive;
}

}  // namespace echoloop::tritech
