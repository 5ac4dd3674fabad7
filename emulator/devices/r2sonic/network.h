// Addresses of an R2Sonic system: where it listens, where its data goes, discovery and configuration. Opens
// no socket.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/r2sonic/settings.h"
#include "protocols/r2sonic/messages.h"

namespace echoloop::r2sonic_device {

/// Addresses of the parts of a system: base ports as R2Sonic counts them.
struct Wiring {
    Address head;                ///< own address, base port
    Address gui;                 ///< host, base port: where data goes
    std::optional<Address> sim;  ///< own address of the SIM, base port
    std::vector<Endpoint> all;   ///< as the scenario has them
};

/// R2Sonic counts up to 7 ports from a base port.
inline constexpr std::uint16_t highest_base_port = 65535 - 7;

/// What a datagram holds decides where it leaves and where it goes.
enum class Product { bathymetry, truepix, status, image, water_column, snippets };
inline constexpr std::size_t products = 6;

/// Places of the device's ports in ports(). Commands arrive where status leaves; the other products have
/// ports of their own. Behind those of the SIM, if there is one, is that of broadcasts.
enum PortIndex : std::size_t {
    head_commands,
    head_discovery,
    first_product,
    sim_commands = first_product + products - 1,
    sim_discovery
};

class Network {
  public:
    Network(const Wiring& wiring, const Settings& settings);

    std::vector<Port> ports() const;
    Address destination(Product product) const;
    /// The port that it leaves from: as far above the head's base as its destination is above the host's.
    static std::size_t source(Product product);
    /// Answers to R2DD: of the head if it is on, and of the SIM if there is one.
    std::vector<Send> answers(const r2sonic::R2dd& request, Address from, bool head_on) const;
    /// Takes over what concerns the head, if it is on, or the SIM. False if it asks for what cannot be:
    /// another address of the device itself (its endpoint says where it listens), one of the host beyond
    /// loopback for a device on loopback, or a base port with too few ports above it.
    bool configure(const r2sonic::R2dc& config, bool head_on);

    bool has_sim() const { return wiring_.sim.has_value(); }
    std::uint32_t head_config() const { return head_config_; }
    std::uint32_t sim_config() const { return sim_config_; }

  private:
    bool has_own_sim_address() const { return wiring_.sim && wiring_.sim->ip != wiring_.head.ip; }
    bool may_send_to(Address host) const;
    bool is_allowed(const r2sonic::R2dc& config, bool for_sim) const;
    Wiring wiring_;
    wire::Text<12> model_, serial_, sim_serial_;
    bool answer_ = true, answer_sender_ = true, configured_hosts_ = false;
    std::array<Address, 2> daq_{};  ///< as configured; port 0: none
    std::uint32_t head_config_ = 0, sim_config_ = 0;
};

}  // namespace echoloop::r2sonic_device
