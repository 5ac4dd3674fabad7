// A Sound Metrics ARIS imaging sonar: beacon and frames by UDP, commands by TCP. A pure state machine.
#pragma once

#include <optional>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/aris/frame.h"
#include "emulator/devices/aris/part_queue.h"
#include "protocols/aris/framer.h"

namespace echoloop::aris_device {

struct Wiring {
    Address own;     ///< where the TCP listener is; beacon and frames come from that address
    Address beacon;  ///< where the beacon goes
};

class Aris final : public Device {
  public:
    Aris(const Settings& settings, const Wiring& wiring);

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
    /// What a controller has set, and what goes with it.
    struct Control {
        std::optional<Address> receiver;
        std::optional<aris::SetAcoustics> acoustics;  ///< as they can be done; none: no frames
        aris::PacketDelay delay;
        Cookies cookies;
    };

    void obey(const aris::Command& command, Time now);
    bool set_receiver(const aris::SetReceiver& wish);
    bool set_acoustics(const aris::SetAcoustics& wish);
    bool set_salinity(std::uint32_t salinity);
    bool set_telephoto(bool telephoto);
    bool set_focus(const aris::SetFocus& wish, Time now);
    bool set_clock(const std::string& text, Time now);
    void take_ack(ByteView bytes);
    void forget_controller();
    /// Starts the controller's time to say something.
    void expect_words(Time now);
    void plan_next_frame(Time now);
    void transmit(Time now);
    /// s from the transmission of a frame that is heard at `due` to the next, if nobody sets anything.
    double interval(Time now, Time due) const;
    void send_frame(const Echogram& echogram, Time now);
    void send_beacon(Time now);
    Actions take_actions();

    Settings settings_;
    Wiring wiring_;
    aris::Framer framer_;
    Control control_;
    bool connected_ = false;
    std::uint32_t salinity_ = 0;  ///< ppt
    bool telephoto_ = false;
    FocusMotor focus_;
    std::int64_t clock_offset_;  ///< us, Unix time at power-up by the sonar's own clock
    FrameRecord frame_;          ///< the frame under way, or the last one; its number is 0 before the first
    std::uint64_t pings_ = 0;    ///< goes on across controllers, unlike numbers of frames
    /// Of frames, whose intervals in recordings differ by up to 0.6 ms.
    PingPacer pacer_{settings_.sensors, {std::chrono::microseconds(1), 600}};
    PartQueue parts_;
    Time next_beacon_ = Time::max();
    std::uint32_t peer_ = 0;           ///< IPv4 address of the controller
    Time next_silence_ = Time::max();  ///< when the controller will have been silent too long
    Actions actions_;
    DeviceCounters counters_;
};

/// The rows of the table of models.
std::vector<Model> models();

}  // namespace echoloop::aris_device
