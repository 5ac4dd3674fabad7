// A Water Linked Sonar 3D-15: HTTP interface by TCP, range and strength images by UDP. A pure state machine.
#pragma once

#include <map>
#include <optional>

#include "emulator/devices/sonar-3d-15/image.h"
#include "emulator/devices/sonar-3d-15/imu.h"
#include "protocols/http/request.h"

namespace echoloop::sonar_3d_15 {

struct Wiring {
    Address own;             ///< where the TCP listener is; images come from the same address
    std::string unicast_ip;  ///< where images go at the start; empty: as the options say
    std::uint16_t unicast_port = 0;
};

class Sonar final : public Device {
  public:
    Sonar(const Settings& settings, const Wiring& wiring);

    std::vector<Port> ports() const override;
    Actions started(Time now) override;
    Actions received(const Received& data, Time now) override;
    Actions heard(const Echogram& echogram, Time now) override;
    Actions woken(Time now) override;
    void reconnected(std::size_t) override {}
    Actions connected(std::size_t port, Address peer, Time now) override;
    Actions disconnected(std::size_t port, Address peer, Time now) override;
    DeviceCounters counters() const override { return counters_; }

  private:
    /// A host on the HTTP port.
    struct Client {
        http::RequestReader reader;
        Time deadline = Time::max();  ///< of a request that is not whole, or has not begun
    };
    /// An image that is being shot.
    struct Shooting {
        Plan plan;
        Time start{};
    };

    void obey(const http::Request& request, Address from, Time now);
    void restart(Time now);
    void begin_image(Time now);
    void send_image(const Echogram& echogram);
    void send_packet(sonar3d::Message message, Address to);
    std::optional<Address> destination() const;
    double speed_of(const State& state) const;
    void respond(Bytes response, Address to, Time when = {});
    sonar3d::Timestamp time_of(Time at) const;
    void plan_imu(Time now);
    void send_imu_batch(Time now);
    Actions take_actions();

    Settings settings_;
    Wiring wiring_;
    State state_;
    std::map<Address, Client> clients_;
    double speed_ = 0;                 ///< m/s, in use
    Time speed_change_ = Time::max();  ///< when the one set is used

    View view_;
    bool view_is_high_ = false;
    std::optional<Shooting> shooting_;
    bool ping_under_way_ = false;
    std::uint64_t shots_ = 0;  ///< transmitted
    std::uint32_t images_ = 0;
    Imu imu_;
    Time next_batch_ = Time::max();
    std::uint32_t batches_ = 0;
    Actions actions_;
    DeviceCounters counters_;
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::sonar_3d_15
