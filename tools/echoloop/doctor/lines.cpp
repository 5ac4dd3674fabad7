#include <unistd.h>

#include <filesystem>

#include "emulator/error.h"
#include "emulator/transport/pty.h"
#include "emulator/transport/serial.h"
#include "emulator/transport/udp.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/doctor/findings.h"

namespace echoloop::cli {
namespace {

using State = Finding::State;

constexpr const char* usual_links = "/tmp/echoloop";

Finding pseudo_terminals(asio::io_context& io) {
    try {
        const Pty pty(io, {});
        return {State::good, "pseudo-terminals", "can be opened and watched", ""};
    } catch (const StartError& error) {
        return {State::bad, "pseudo-terminals", error.what(),
                "mount /dev/pts, or use tcp-listen:// endpoints"};
    }
}

Finding links() {
    namespace fs = std::filesystem;
    std::error_code ec;
    if (!fs::exists(usual_links, ec))
        return {State::good, "links", std::string(usual_links) + " will be made", ""};
    if (::access(usual_links, W_OK) == 0)
        return {State::good, "links", std::string(usual_links) + " can be written", ""};
    return {
        State::weak, "links", std::string(usual_links) + " belongs to another user",
        "name another folder in the endpoints, e.g. pty:/run/user/" + std::to_string(::getuid()) + "/micron"};
}

Finding serial() {
    std::string usable, denied;
    for (const SerialPortName& port : serial_ports())
        (port.permitted ? usable : denied) +=
            (port.permitted ? usable : denied).empty() ? port.path : ", " + port.path;
    if (!denied.empty())
        return {State::weak, "serial ports", denied + " may not be opened",
                "join the group that owns them: sudo adduser $USER dialout, and log in again"};
    return {State::good, "serial ports", usable.empty() ? "none here; pty: endpoints stand for them" : usable,
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
