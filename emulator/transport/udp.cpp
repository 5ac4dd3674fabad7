#include "emulator/transport/udp.h"

#include <spdlog/spdlog.h>

#include <vector>

#include "emulator/transport/address.h"

namespace echoloop {
namespace {

asio::ip::udp::socket bind_socket(asio::io_context& io, Address bind, bool shared) {
    using SocketBase = asio::socket_base;
    asio::ip::udp::socket socket(io, asio::ip::udp::v4());
    socket.set_option(SocketBase::reuse_address(shared));
    socket.set_option(SocketBase::broadcast(true));
    error_code ec;
    socket.set_option(SocketBase::send_buffer_size(1 << 20), ec);
    socket.bind(to_endpoint<asio::ip::udp::endpoint>(bind), ec);
    const std::string place = "udp-listen://" + to_text(bind);
    if (ec == asio::error::address_in_use && shared) {
        spdlog::warn(
            "{}: another program has it for itself (`ss -lunp` shows which), so the sonar does not "
            "hear who looks for it there and answers nobody; end that program, or switch discovery "
            "off by the device's option, to lose this line",
            place);
        socket.close();
        return socket;
    }
    if (ec) throw bind_error(place, ec);
    socket.non_blocking(true);
    return socket;
}

}  // namespace

Udp::Udp(asio::io_context& io, Address bind, bool shared, Peers peers, Address reply_to)
    : socket_(bind_socket(io, bind, shared)), bind_(bind), peers_(std::move(peers)), reply_to_(reply_to) {}

void Udp::start(Events events) {
    events_ = std::move(events);
    asio::co_spawn(socket_.get_executor(), read_datagrams(), Serving(describe()));
}

Task<void> Udp::read_datagrams() {
    std::vector<std::uint8_t> buffer(65536);
    error_code ec;
    while (socket_.is_open()) {
        asio::ip::udp::endpoint from;
        const std::size_t n = co_await socket_.async_receive_from(asio::buffer(buffer), from, into(ec));
        if (ec == asio::error::operation_aborted || !socket_.is_open()) co_return;
        if (ec) continue;  // an unreachable peer of an earlier datagram
        count_in(n);
        if (n > 0) reply_to_ = to_address(from);
        events_.received(ByteView(buffer).first(n), to_address(from));
    }
}

Task<void> Udp::write(ByteView bytes, Address to) {
    if (to.port == 0) to = reply_to_;
    if (to.port == 0 || !socket_.is_open()) co_return;
    if (!may_send_to(to.ip)) {
        if (refused_++ == 0)
            spdlog::warn("{}: nothing is sent to {}, which is in none of the networks {}; name it in `peers`",
                         describe(), to_text(to),
                         peers_.describe().empty() ? "127.0.0.0/8" : peers_.describe());
        co_return;
    }
    error_code ec;
    const auto where = to_endpoint<asio::ip::udp::endpoint>(to);
    std::size_t n = socket_.send_to(asio::buffer(bytes.data(), bytes.size()), where, 0, ec);
    if (ec == asio::error::would_block)
        n = co_await socket_.async_send_to(asio::buffer(bytes.data(), bytes.size()), where, into(ec));
    if (ec) {
        spdlog::debug("udp to {}: {}", to_text(to), ec.message());
        count_lost(bytes.size());
    } else {
        count_out(n);
    }
}

bool Udp::may_send_to(std::uint32_t ip) const {
    constexpr std::uint32_t all_of_the_network = 0xFFFFFFFF;
    return peers_.holds(ip) || asio::ip::address_v4(ip).is_multicast() ||
           (ip == all_of_the_network && !peers_.describe().empty());
}

void Udp::close() {
    error_code ignored;
    socket_.close(ignored);
}

Address Udp::local() const {
    error_code ec;
    const auto own = socket_.local_endpoint(ec);
    return ec ? bind_ : to_address(own);
}

std::string Udp::describe() const { return "udp-listen://" + to_text(local()); }

Wire Udp::wire() const { return {Wire::Kind::udp, local(), reply_to_}; }

}  // namespace echoloop
