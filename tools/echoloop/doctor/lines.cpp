#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <thread>

#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

#include "emulator/contract/error.h"
#include "emulator/transport/own_folder.h"
#include "emulator/transport/pty.h"
#include "emulator/transport/serial.h"
#include "emulator/transport/udp.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/doctor/findings.h"

namespace echoloop::cli {
namespace {

using State = Finding::State;

constexpr const char* usual_links = "/tmp/echoloop";

/// ms that a byte takes from one side of a pseudo-terminal to the other: what one in two and 99 of 100 do not
/// exceed. Throws std::system_error.
std::pair<double, double> time_across_a_pty() {
    using Clock = std::chrono::steady_clock;
    asio::io_context io;
    asio::posix::stream_descriptor near(io, ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
    ::grantpt(near.native_handle());
    ::unlockpt(near.native_handle());
    asio::posix::stream_descriptor far(
        io, ::open(::ptsname(near.native_handle()), O_RDWR | O_NOCTTY | O_CLOEXEC));
    termios raw{};
    ::cfmakeraw(&raw);
    ::tcsetattr(far.native_handle(), TCSANOW, &raw);
    std::array<double, 100> late{};
    for (double& ms : late) {
        const auto begin = Clock::now();
        std::uint8_t byte = 1;
        asio::write(near, asio::buffer(&byte, 1));
        asio::read(far, asio::buffer(&byte, 1));
        ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::ranges::sort(late);
    return {late[late.size() / 2], late[late.size() - 2]};
}

Finding pseudo_terminals(asio::io_context& io) {
    try {
        const Pty pty(io, {});
        const auto [median, most] = time_across_a_pty();
        const std::string text = "can be opened and watched; a byte takes " + plain(median, 2) +
                                 " ms, 1 of 100 more than " + plain(most, 2) + " ms";
        if (most <= 1) return {State::good, "pseudo-terminals", text, ""};
        return {State::weak, "pseudo-terminals", text,
                "a kernel thread carries the bytes and competes with all busy programs, on real serial ports "
                "too; a less busy machine is more punctual"};
    } catch (const std::exception& error) {
        return {State::bad, "pseudo-terminals", error.what(),
                "without them use tcp-listen:// or udp-listen:// endpoints"};
    }
}

Finding links() {
    namespace fs = std::filesystem;
    std::error_code ec;
    if (!fs::exists(usual_links, ec))
        return {State::good, "links", std::string(usual_links) + " will be made", ""};
    if (::access(usual_links, W_OK) == 0)
        return {State::good, "links", std::string(usual_links) + " can be written", ""};
    return {State::weak, "links", std::string(usual_links) + " belongs to another user",
            "name another folder in the endpoints, e.g. pty:" + (place_of_ones_own() / "micron").string()};
}

Finding serial() {
    std::string usable, denied;
    for (const SerialPortName& port : serial_ports())
        (port.permitted ? usable : denied) +=
            (port.permitted ? usable : denied).empty() ? port.path : ", " + port.path;
    if (!denied.empty())
        return {State::weak, "serial ports", denied + " may not be opened",
                "join the group that owns them: sudo adduser $USER dialout, and log in again"};
    return {State::good, "serial ports", usable.empty() ? "none found; use pty: endpoints instead" : usable,
            ""};
}

Finding sockets(asio::io_context& io) {
    try {
        Udp(io, {0x7F000001, 0}, false);
        return {State::good, "sockets", "loopback works", ""};
    } catch (const StartError& error) {
        return {State::bad, "sockets", error.what(), "bring loopback up: ip link set lo up"};
    }
}

}  // namespace

Findings look_at_lines() {
    asio::io_context io;
    return {pseudo_terminals(io), links(), serial(), sockets(io)};
}

}  // namespace echoloop::cli
