// Whom a place on the network may send to, and who may connect to it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "emulator/contract/network.h"

namespace echoloop {

class Peers {
  public:
    /// Of a place bound to `bound` (0: all addresses of this machine): on loopback, loopback; elsewhere the
    /// networks that the scenario names, or without any those of the interface that has the address; and this
    /// machine under all of its addresses.
    /// `destinations`: addresses that the scenario sends to in any case.
    Peers(std::uint32_t bound, std::span<const Network> named,
          std::span<const std::uint32_t> destinations = {});

    bool holds(std::uint32_t ip) const;
    /// Not asked for on loopback, where only programs of this machine are: "".
    std::string describe() const;

  private:
    std::vector<Network> networks_;
    std::vector<std::uint32_t> own_;  ///< addresses of this machine
    bool on_loopback_;
};

}  // namespace echoloop
