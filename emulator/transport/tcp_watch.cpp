#include "emulator/transport/tcp_watch.h"

#include <netinet/tcp.h>
#include <sys/socket.h>

#include <chrono>
#include <utility>

namespace echoloop {
namespace {

using Socket = asio::ip::tcp::socket;

void set(Socket& socket, int level, int name, int value) {
    ::setsockopt(socket.native_handle(), level, name, &value, sizeof value);
}

/// An idle connection is asked for a sign of life after 5 s, three times.
void keep_alive(Socket& socket) {
    set(socket, IPPROTO_TCP, TCP_KEEPIDLE, 5);
    set(socket, IPPROTO_TCP, TCP_KEEPINTVL, 2);
    set(socket, IPPROTO_TCP, TCP_KEEPCNT, 3);
    set(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
}

/// With bytes on their way: after 0.2 s they are sent again, then after twice as long each time. The option
/// TCP_USER_TIMEOUT would not do: it ends the connection of a driver that stands, too, whose kernel answers.
bool is_gone(Socket& socket) {
    constexpr int unanswered = 6;  // 13 s
    tcp_info info{};
    socklen_t size = sizeof info;
    return ::getsockopt(socket.native_handle(), IPPROTO_TCP, TCP_INFO, &info, &size) == 0 &&
           info.tcpi_retransmits + info.tcpi_probes >= unanswered;
}

/// Whether there is something to watch any more.
bool look_after(const std::shared_ptr<Socket>& socket) {
    if (!socket || !socket->is_open()) return false;
    if (!is_gone(*socket)) return true;
    error_code ignored;
    socket->close(ignored);
    return false;
}

Task<void> watch(asio::any_io_executor executor, std::weak_ptr<Socket> socket) {
    asio::steady_timer timer(executor);
    error_code ec;
    while (look_after(socket.lock())) {
        timer.expires_after(std::chrono::seconds(1));
        co_await timer.async_wait(into(ec));
    }
}

}  // namespace

void watch_far_end(const std::shared_ptr<Socket>& socket) {
    keep_alive(*socket);
    asio::co_spawn(socket->get_executor(), watch(socket->get_executor(), socket), Serving("tcp"));
}

}  // namespace echoloop
