#include "emulator/devices/r2sonic/network.h"

#include "protocols/r2sonic/codec.h"

namespace echoloop::r2sonic_device {
namespace {

constexpr std::uint16_t commands = 2;                     // above the base port of head and SIM
constexpr std::uint32_t loopback_broadcast = 0x7FFFFFFF;  // 127.255.255.255

Address with_offset(Address base, std::uint16_t offset) {
    return {base.ip, static_cast<std::uint16_t>(base.port + offset)};
}

/// As the model's row says where they go.
constexpr const char* product_names[products]{"bathymetry", "TruePix",      "status",
                                              "images",     "water column", "snippets"};

/// Above the host's base port.
std::uint16_t offset_of(Product product) {
    switch (product) {
        case Product::bathymetry:
            return 0;
        case Product::truepix:
            return 1;
        case Product::status:
            return 2;
        case Product::image:
            return 3;
        case Product::water_column:
            return 5;
        case Product::snippets:
            return 6;
    }
    return 0;
}

}  // namespace

Network::Network(const Wiring& wiring, const Settings& settings)
    : wiring_(wiring),
      model_(settings.model),
      serial_(settings.serial),
      sim_serial_(settings.sim_serial),
      answer_(settings.discovery != Discovery::none),
      answer_sender_(settings.discovery == Discovery::sender),
      configured_hosts_(settings.configured_hosts) {}

std::size_t Network::source(Product product) {
    if (product == Product::status) return head_commands;
    const auto place = static_cast<std::size_t>(product);
    return first_product + place - (product > Product::status ? 1 : 0);
}

/// Whoever asks for discovery is answered from the address of the part that answers, so each part listens at
/// its own; a broadcast arrives at one more.
std::vector<Port> Network::ports() const {
    constexpr auto datagram = Port::Kind::datagram;
    std::vector<Port> ports;
    const auto discovery = [&](const char* name, std::uint32_t ip) {
        ports.push_back({name, datagram, {ip, r2sonic::discovery_port}, true});
    };
    ports.push_back({"commands", datagram, with_offset(wiring_.head, commands), false});
    discovery("discovery", wiring_.head.ip);
    for (std::size_t i = 0; i < products; ++i)
        if (const auto product = static_cast<Product>(i); product != Product::status)
            ports.push_back(
                {product_names[i], datagram, with_offset(wiring_.head, offset_of(product)), false});
    if (wiring_.sim) ports.push_back({"SIM commands", datagram, with_offset(*wiring_.sim, commands), false});
    if (has_own_sim_address()) discovery("SIM discovery", wiring_.sim->ip);
    if (wiring_.head.ip != 0)
        discovery("discovery broadcast", is_loopback(wiring_.head.ip) ? loopback_broadcast : 0);
    return ports;
}

Address Network::destination(Product product) const {
    const bool column = product == Product::water_column;
    const bool acquired = column || product == Product::truepix || product == Product::snippets;
    const Address& daq = daq_[column ? 1 : 0];
    const bool to_daq = configured_hosts_ && acquired && daq.port != 0;
    return with_offset(to_daq ? daq : wiring_.gui, offset_of(product));
}

std::vector<Send> Network::answers(const r2sonic::R2dd& request, Address from, bool head_on) const {
    if (!answer_) return {};
    const Address to = answer_sender_ ? from : Address{request.gui_ip, request.gui_port};
    if (is_loopback(wiring_.head.ip) && !is_loopback(to.ip)) return {};
    const auto answer = [&](std::size_t port, const r2sonic::R2di& packet) {
        return Send{port, r2sonic::serialise(packet), to, {}};
    };
    const std::size_t sim_port = has_own_sim_address() ? sim_discovery : head_discovery;
    std::vector<Send> out;
    if (head_on) out.push_back(answer(head_discovery, {serial_, "15000001", model_, {}}));
    if (wiring_.sim) out.push_back(answer(sim_port, {sim_serial_, "15000003", "SIM", {}}));
    return out;
}

/// A head on loopback sends to loopback only, whatever the host's program says. Port 0 is no address.
bool Network::may_send_to(Address host) const {
    if (host.port == 0) return true;
    if (host.port > highest_base_port) return false;
    return !is_loopback(wiring_.head.ip) || is_loopback(host.ip);
}

bool Network::is_allowed(const r2sonic::R2dc& config, bool for_sim) const {
    if (!may_send_to({config.gui_ip, config.gui_port})) return false;
    for (std::size_t i = 0; i < daq_.size(); ++i)
        if (configured_hosts_ && !may_send_to({config.daq_ip[i], config.daq_port[i]})) return false;
    const Address own = for_sim ? *wiring_.sim : wiring_.head;
    const std::size_t system = std::min<std::size_t>(config.system_index, config.head_ip.size() - 1);
    const Address asked = for_sim ? Address{config.sim_ip[system], config.sim_port[system]}
                                  : Address{config.head_ip[system], config.head_port[system]};
    if (asked.ip == 0 || asked.port == 0) return true;  // none is asked for
    return asked.port == own.port && (own.ip == 0 || asked.ip == own.ip);
}

bool Network::configure(const r2sonic::R2dc& config, bool head_on) {
    const bool for_sim = wiring_.sim && config.serial == sim_serial_;
    const bool for_head = head_on && config.serial == serial_;
    if (!for_head && !for_sim) return true;
    if (!is_allowed(config, for_sim)) return false;
    (for_sim ? sim_config_ : head_config_) = config.config_id;
    if (config.gui_port != 0) wiring_.gui = {config.gui_ip, config.gui_port};
    for (std::size_t i = 0; i < daq_.size(); ++i) daq_[i] = {config.daq_ip[i], config.daq_port[i]};
    return true;
}

}  // namespace echoloop::r2sonic_device
