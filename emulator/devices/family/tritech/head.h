// What all SeaNet heads do with bytes and time: frames, start, mtAlive, version and user block, requests and
// the serial line. Knows neither what a ping looks like nor what a reply carries.
#pragma once

#include "emulator/contract/host_lines.h"
#include "emulator/devices/family/tritech/boot.h"
#include "emulator/devices/family/tritech/head_options.h"
#include "emulator/devices/family/tritech/requests.h"
#include "protocols/seanet/framer.h"
#include "protocols/seanet/messages.h"

namespace echoloop::tritech {

class Head : public Device {
  public:
    explicit Head(const HeadSettings& settings);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t port) override;
    DeviceCounters counters() const override;

  protected:
    /// A message that is not for every head. False if it is not understood or refused.
    virtual bool configure(const seanet::Message& message, Time now) = 0;
    /// Begins a reply: sets actions_.ping. The head has parameters, is centred and its line is free.
    virtual void begin(Time now) = 0;
    /// mtReBoot: parameters are gone, the head points ahead.
    virtual void forget() = 0;
    virtual std::uint16_t position() const = 0;
    /// Something else that wants the water between two replies, as an echosounder on the AUX port.
    virtual Time side_work_due() const { return Time::max(); }
    virtual void begin_side_work(Time) {}

    /// New parameters are in force: what was under way is void, and an mtAlive acknowledges them.
    void configured(Time now);
    bool centred(Time now) const { return boot_.centred(now); }
    Time line_time(std::size_t frame_bytes) const;
    /// Numbers a ping of a reply, which is under way from now on and heard at `due`.
    std::uint64_t begin_ping(Time due);
    /// The same for side work, which neither moves the motor nor holds mtAlive back.
    std::uint64_t begin_side_ping();
    bool is_under_way(std::uint64_t ping) const { return under_way_ && ping == ping_; }
    /// The last ping of a reply was heard and `bytes` go out.
    void finish_reply(Time now, std::size_t bytes);
    /// The same for side work.
    void finish_side_work(Time now, std::size_t bytes);
    bool has_requests() const { return requests_.any(); }
    void reply(const seanet::Message& message);
    Actions take_actions();

    Actions actions_;  ///< of the call at hand
    DeviceCounters counters_;

  private:
    void obey(const seanet::Frame& frame, const Peer& host, Time now);
    bool answer(const seanet::Message& message, Time now);
    void send_user_block();
    void reboot(Time now);
    void request(const seanet::SendData& request, Time now);
    bool ready(Time now) const { return has_parameters_ && boot_.centred(now); }
    void send_alive(Time now);
    void drop_requests();
    void schedule(Time now);
    void begin_due(Time now);

    HeadSettings settings_;
    HostLines<seanet::Framer> hosts_;
    Peer host_;  ///< whose message was understood last: the head talks to it
    Boot boot_;
    Requests requests_;
    bool has_parameters_ = false;
    bool under_way_ = false;
    bool side_work_last_ = false;    ///< rather than a line
    std::uint64_t ping_ = 0;         ///< number of the ping under way; echoes of others are stale
    Time line_free_{};               ///< when the last reply has left the serial port
    Time next_begin_ = Time::max();  ///< of a reply or of side work
};

}  // namespace echoloop::tritech
