// A Cerulean sonar that pings at its host's interval and reports each ping to it: its link, its identity, its
// pace. A pure state machine; knows no message of a particular sonar.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "emulator/contract/ping_pacer.h"
#include "emulator/devices/family/cerulean/common.h"
#include "protocols/cerulean/codec.h"
#include "protocols/cerulean/ids.h"

namespace echoloop::cerulean_device {

using ping_device::Peer;

class Sonar : public Device {
  public:
    Sonar(const Identity& identity, const Sensors& sensors, std::vector<Endpoint> endpoints);

    std::vector<Port> ports() const override { return ports_; }
    Actions started(Time) override { return take_actions(); }
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override { link_.reset(port); }
    void line_rate(std::size_t port, double rate) override;
    DeviceCounters counters() const override;

  protected:
    virtual void obey(const ping::Frame& frame, const Peer& peer, Time now) = 0;
    /// Sends the message of a get id beside those that all devices have; false if there is none.
    virtual bool send_own(ping::Id id, const Peer& peer) = 0;
    /// The next ping as the host has set it, complete but for its number.
    virtual Shot next_shot() = 0;
    /// s from the transmission of that ping to its report.
    virtual double ping_time() const = 0;
    /// Least time from one ping to the next.
    virtual Time interval() const = 0;
    /// Keeps what was heard, and tells listener().
    virtual void report(const Echogram& echogram) = 0;

    /// Calls `on(message)` for the message of a frame, which says whether a device obeys it. Message: the
    /// variant of its messages.
    template <class Message, class On>
    void obey_with(const ping::Frame& frame, const Peer& peer, const On& on);
    void on(const ping::GeneralRequest& request, const Peer& peer, Time now);
    /// Takes a host's speed of sound in mm/s over into `speed` and acknowledges it, or refuses it.
    void set_speed_of_sound(std::uint32_t wanted, cerulean::Id id, const Peer& peer, std::uint32_t& speed);
    bool send_message(ping::Id id, const Peer& peer);
    void acknowledge(cerulean::Id id, const Peer& peer);
    void refuse(ping::Id id, std::string_view text, const Peer& peer);
    template <class Message>
    void reply(const Message& message, const Peer& peer);

    void understood() { ++counters_.messages; }
    void not_understood() { ++counters_.rejected; }
    std::uint8_t source() const { return link_.id(); }
    void set_source(std::uint8_t id) { link_.set_id(id); }

    /// Pings for this host from now on.
    void start_pings(const Peer& listener, Time now);
    void stop_pings() { pacer_.stop(); }
    void only_this_ping() { pacer_.once(); }
    const Peer& listener() const { return listener_; }
    std::uint64_t pings() const { return pings_; }  ///< that went out
    /// ms from power-up to the last ping.
    std::uint32_t pinged_at() const;
    /// What its sensor of that name reads at this moment.
    double read(std::string_view name, double truth, const Stray& stray) const {
        return sensors_.read(name, truth, stray, now_);
    }
    double read_compass(double truth) const {
        return sensors_.read_bearing("compass", truth, stray::compass, now_);
    }

  private:
    void discover(const Received& data);
    void transmit(Time now);
    Actions take_actions();

    Identity identity_;
    Sensors sensors_;
    std::vector<Endpoint> endpoints_;
    std::vector<Port> ports_;
    std::vector<std::size_t> pieces_;  ///< largest datagram per port; 0: a stream
    ping_device::Link link_;
    Peer listener_;  ///< who asked for the pings
    PingPacer pacer_{sensors_, jitter::processor};
    Time now_{};  ///< of the call at hand
    std::uint64_t pings_ = 0;
    Time pinged_at_{};
    Actions actions_;  ///< of the call at hand
    DeviceCounters counters_;
};

inline constexpr std::string_view unknown_command = "command not recognised";

template <class Message>
void Sonar::reply(const Message& message, const Peer& peer) {
    for (Send& send : link_.reply_in_pieces(message, peer, pieces_.at(peer.port)))
        actions_.send.push_back(std::move(send));
}

template <class Message, class On>
void Sonar::obey_with(const ping::Frame& frame, const Peer& peer, const On& on) {
    using Codec = cerulean::Codec<Message>;
    if (Codec::is_short_request(frame) && send_message(frame.header.id, peer)) {
        ++counters_.messages;
        return;
    }
    const auto message = Codec::parse(frame);
    // What it does not know it drops without a word, and what devices say: else two of them would not end.
    if (!message && message.error().reason != wire::Reason::unknown_message)
        refuse(frame.header.id, "wrong length", peer);
    else if (message && std::visit(on, *message))
        ++counters_.messages;
    else
        ++counters_.rejected;
}

}  // namespace echoloop::cerulean_device
