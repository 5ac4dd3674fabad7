// A transport on real sockets of loopback, and what it tells.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "emulator/transport/address.h"
#include "emulator/transport/transport.h"

namespace echoloop::test {

using namespace std::chrono_literals;

inline constexpr std::uint32_t loopback = 0x7F000001;

class SocketTest : public testing::Test {
  protected:
    template <class Done>
    bool run_until(Done done) {
        const auto end = std::chrono::steady_clock::now() + 3s;
        while (!done() && std::chrono::steady_clock::now() < end) {
            io_.restart();
            io_.run_for(1ms);
        }
        return done();
    }
    void start(Transport& transport) {
        transport.start({[this](ByteView bytes, Address from) {
                             heard_.emplace_back(bytes.begin(), bytes.end());
                             from_ = from;
                         },
                         [this] { ++reconnected_; }, [this](Address peer) { peer_ = peer; },
                         [this](Address) { ++gone_; }});
    }
    void write(Transport& transport, const Bytes& bytes, Address to = {}) {
        bool done = false;
        asio::co_spawn(
            io_, [&]() -> Task<void> { co_await transport.write(bytes, to); },
            [&done](std::exception_ptr) { done = true; });
        run_until([&] { return done; });
    }
    /// The port at the end of "tcp-listen://127.0.0.1:41234".
    static std::uint16_t port_of(const Transport& transport) {
        const std::string text = transport.describe();
        return static_cast<std::uint16_t>(std::stoi(text.substr(text.rfind(':') + 1)));
    }

    asio::io_context io_;
    std::vector<Bytes> heard_;
    Address from_;
    int reconnected_ = 0;
    Address peer_;
    int gone_ = 0;
};

}  // namespace echoloop::test
