#include "emulator/transport/tcp_door.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "emulator/transport/address.h"
#include "emulator/transport/tcp.h"

namespace echoloop {
namespace {

using Tcp = asio::ip::tcp;

Tcp::acceptor bind_acceptor(asio::io_context& io, Address bind, int send_buffer) {
    Tcp::acceptor acceptor(io, Tcp::v4());
    acceptor.set_option(Tcp::acceptor::reuse_address(true));
    error_code ec;
    if (send_buffer > 0)
        acceptor.set_option(Tcp::socket::send_buffer_size(send_buffer), ec);  // drivers inherit it
    acceptor.bind(to_endpoint<Tcp::endpoint>(bind), ec);
    if (!ec) acceptor.listen(Tcp::acceptor::max_listen_connections, ec);
    if (ec) throw bind_error("tcp-listen://" + to_text(bind), ec);
    return acceptor;
}

}  // namespace

TcpDoor::TcpDoor(asio::io_context& io, Address bind, Manners manners)
    : io_(io), manners_(manners), acceptor_(bind_acceptor(io, bind, manners.send_buffer)) {}

void TcpDoor::remove(TcpListener& line) { std::erase(lines_, &line); }

void TcpDoor::begin() {
    if (!std::exchange(begun_, true)) asio::co_spawn(io_, let_in(), Serving(describe()));
}

Task<void> TcpDoor::let_in() {
    error_code ec;
    while (acceptor_.is_open()) {
        Tcp::socket socket = co_await acceptor_.async_accept(into(ec));
        if (ec == asio::error::operation_aborted || !acceptor_.is_open()) co_return;
        if (ec) {
            asio::steady_timer breath(acceptor_.get_executor(), std::chrono::milliseconds(100));
            co_await breath.async_wait(into(ec));
            continue;
        }
        if (TcpListener* const idle = free_line() == nullptr ? idle_line() : nullptr) {
            spdlog::warn("{}: {} said and took nothing for {:.0f} s, and makes way for another driver",
                         describe(), to_text(idle->wire().remote), idle->idle_time());
            co_await idle->let_go();
        }
        if (TcpListener* const line = free_line())
            line->take(std::move(socket));
        else if (serves_several())
            spdlog::warn("{}: another driver was turned away; {} are connected already", describe(),
                         lines_.size());
        else
            spdlog::warn("{}: a second driver was turned away; one is connected already", describe());
    }
}

TcpListener* TcpDoor::free_line() const {
    for (TcpListener* line : lines_)
        if (!line->has_driver()) return line;
    return nullptr;
}

TcpListener* TcpDoor::idle_line() const {
    if (!manners_.idle || lines_.empty()) return nullptr;
    TcpListener* const line = *std::ranges::max_element(lines_, {}, &TcpListener::idle_time);
    return line->has_driver() && line->idle_time() >= *manners_.idle ? line : nullptr;
}

void TcpDoor::shut() {
    if (shut_.port != 0) return;
    shut_ = address();
    error_code ignored;
    acceptor_.close(ignored);
}

void TcpDoor::open() {
    if (shut_.port == 0) return;
    const Address bind = std::exchange(shut_, {});
    try {
        acceptor_ = bind_acceptor(io_, bind, manners_.send_buffer);
        asio::co_spawn(io_, let_in(), Serving(describe()));
    } catch (const StartError& error) {
        spdlog::error("{}; it stays unplugged", error.what());
    }
}

void TcpDoor::close() {
    shut_ = {};
    error_code ignored;
    acceptor_.close(ignored);
}

Address TcpDoor::address() const {
    error_code ec;
    return to_address(acceptor_.local_endpoint(ec));
}

std::string TcpDoor::describe() const { return "tcp-listen://" + to_text(address()); }

}  // namespace echoloop
