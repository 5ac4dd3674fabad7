// What every Imagenex head does on its line: one command, one ping, one reply, and never a word unasked. A
// pure state machine; where the head looks and when it transmits is the model's.
#pragma once

#include <optional>

#include "emulator/contract/host_lines.h"
#include "emulator/devices/family/imagenex/echo.h"
#include "emulator/devices/family/imagenex/settings.h"
#include "protocols/imagenex/framer.h"
#include "protocols/imagenex/messages.h"

namespace echoloop::imagenex_head {

class Head : public Device {
  public:
    explicit Head(const Settings& settings);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override;
    DeviceCounters counters() const override;

  protected:
    /// Range, pulse and so on within what the head can do.
    virtual imagenex::SwitchCommand usable(imagenex::SwitchCommand command) const = 0;
    /// m, of the samples and of the profile range at this range.
    virtual double resolution(const imagenex::SwitchCommand& command) const = 0;
    /// Moves the head and completes the shot: direction, frequency, pulse. Returns how much longer the move
    /// takes than a step.
    virtual Time aim(const imagenex::SwitchCommand& command, Shot& shot) = 0;
    /// Bytes 5 and 6 of the reply.
    virtual imagenex::Packed14 position_bytes() const = 0;
    /// Profile range in the units of the wire.
    virtual std::uint64_t profile_units(double range, const imagenex::SwitchCommand& command) const = 0;
    /// When a command that came at `now` is to transmit: now, or later where something else triggers.
    virtual Time transmit_time(const imagenex::SwitchCommand&, Time now) { return now; }
    /// The head pings on by itself after a reply: when; Time::max() if it waits for the next command.
    virtual Time next_by_itself(const imagenex::SwitchCommand&, Time) { return Time::max(); }
    /// A command for another id; true if something on this line that is not the head obeys it.
    virtual bool obey_other(const wire::Bytes&, Time) { return false; }

    /// Hands bytes to the line, no earlier than `when`, at the rate that byte 21 of their command asks for.
    void send(wire::Bytes bytes, Time when, std::uint8_t reply_baud);
    const Settings& settings() const { return settings_; }

  private:
    bool is_for_us(const imagenex::SwitchCommand& command) const;
    void obey(const imagenex::SwitchCommand& command, Time now);
    void begin(const imagenex::SwitchCommand& command, Time now);
    void transmit(Time now);
    std::uint8_t status_of(const imagenex::SwitchCommand& command) const;
    void end_of_reply(std::size_t bytes, Time now);
    Actions take_actions();

    Settings settings_;
    HostLines<imagenex::Framer> hosts_{imagenex::Framer(imagenex::Framer::Takes::commands)};
    Peer host_;                                       ///< whose command was taken last: the head answers it
    std::optional<imagenex::SwitchCommand> current_;  ///< being served
    std::optional<imagenex::SwitchCommand> waiting_;  ///< came meanwhile; only the newest is kept
    Time transmit_at_ = Time::max();
    Time line_free_{};        ///< when the last reply has left the line
    bool under_way_ = false;  ///< a ping is in the water
    std::uint64_t ping_ = 0;  ///< number of the last ping; echoes of others are stale
    Actions actions_;         ///< of the call at hand
    DeviceCounters counters_;
};

}  // namespace echoloop::imagenex_head
