#include "emulator/transport/tcp.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <utility>

#include "emulator/transport/address.h"
#include "emulator/transport/tcp_watch.h"
#include "emulator/transport/web_request.h"

namespace echoloop {
namespace {

using Tcp = asio::ip::tcp;

/// What does not begin to fit the socket buffer of a driver that does not read is lost; but a message that
/// has begun is finished, since nobody finds the next one behind half of it.
Task<std::size_t> write_or_lose(Tcp::socket& socket, ByteView bytes) {
    constexpr std::chrono::milliseconds patience(2000), pause(2);
    const auto give_up = std::chrono::steady_clock::now() + patience;
    std::size_t sent = 0;
    while (sent < bytes.size() && socket.is_open()) {
        error_code ec;
        sent += socket.write_some(asio::buffer(bytes.data() + sent, bytes.size() - sent), ec);
        if (!ec) continue;
        if (ec != asio::error::would_block) break;
        if (sent == 0 && std::chrono::steady_clock::now() > give_up) break;
        asio::steady_timer timer(socket.get_executor(), pause);
        co_await timer.async_wait(into(ec));
    }
    co_return sent;
}

Wire ends_of(const Tcp::socket& socket, Wire::Kind kind) {
    error_code ec;
    return {kind, to_address(socket.local_endpoint(ec)), to_address(socket.remote_endpoint(ec))};
}

void prepare(Tcp::socket& socket) {
    error_code ignored;
    socket.set_option(Tcp::no_delay(true), ignored);
    socket.non_blocking(true, ignored);
}

/// Behind everything that was written, as a server ends a connection; the reader then meets its end.
void hang_up_on(Tcp::socket& socket) {
    error_code ignored;
    socket.shutdown(Tcp::socket::shutdown_both, ignored);
}

void close_with_reset(Tcp::socket& socket) {
    error_code ignored;
    socket.set_option(Tcp::socket::linger(true, 0), ignored);
    socket.close(ignored);
}

}  // namespace

TcpListener::TcpListener(std::shared_ptr<TcpDoor> door) : door_(std::move(door)), last_answer_(door_->io()) {
    door_->add(*this);
}

TcpListener::~TcpListener() {
    close();
    door_->remove(*this);
}

void TcpListener::start(Events events) {
    events_ = std::move(events);
    door_->begin();
}

void TcpListener::take(Tcp::socket driver) {
    prepare(driver);
    driver_ = std::make_shared<Tcp::socket>(std::move(driver));
    watch_far_end(driver_);
    hung_up_ = false;
    lively_ = std::chrono::steady_clock::now();
    const Address peer = wire().remote;
    events_.reconnected();
    events_.connected(peer);
    asio::co_spawn(door_->io(), serve(driver_, peer), Serving(describe()));
}

Task<void> TcpListener::let_go() {
    const auto driver = driver_;
    hung_up_ = true;
    if (driver) hang_up_on(*driver);  // its reader meets the end, and cleans up as after one that leaves
    constexpr std::chrono::milliseconds pause(1);
    error_code ec;
    for (int i = 0; i < 1000 && driver && driver == driver_; ++i) {
        asio::steady_timer timer(door_->io(), pause);
        co_await timer.async_wait(into(ec));
    }
}

Task<void> TcpListener::serve(std::shared_ptr<Tcp::socket> driver, Address peer) {
    std::array<std::uint8_t, 4096> buffer;
    WebRequest web;
    error_code ec;
    while (driver->is_open()) {
        const std::size_t n = co_await driver->async_read_some(asio::buffer(buffer), into(ec));
        if (ec) break;
        count_in(n);
        lively_ = std::chrono::steady_clock::now();
        if (!door_->manners().speaks_http && web.is_begun_by(ByteView(buffer).first(n))) {
            spdlog::warn("{}: a web browser was turned away", describe());
            break;
        }
        events_.received(ByteView(buffer).first(n), {});
    }
    if (ec == asio::error::eof && door_->manners().answers_half_closed) co_await wait_for_last_answer();
    const bool forgotten = std::ranges::find(forgotten_, driver) != forgotten_.end();
    if (!forgotten) driver->close(ec);
    if (driver == driver_) driver_.reset();
    // The one driver's place stays its own while the cable is pulled; of several, each is another.
    if (!closed_ && (door_->is_open() || door_->serves_several())) events_.disconnected(peer);
}

Task<void> TcpListener::wait_for_last_answer() {
    error_code ec;
    last_answer_.expires_after(std::chrono::milliseconds(500));
    if (!hung_up_) co_await last_answer_.async_wait(into(ec));
}

Task<void> TcpListener::write(ByteView bytes, Address) {
    const auto driver = driver_;
    if (!driver) co_return;
    const std::size_t sent = co_await write_or_lose(*driver, bytes);
    count_out(sent);
    if (sent > 0 && driver == driver_) lively_ = std::chrono::steady_clock::now();
    if (driver->is_open()) count_lost(bytes.size() - sent);
}

void TcpListener::hang_up(Address) {
    hung_up_ = true;
    last_answer_.cancel();
    if (driver_) hang_up_on(*driver_);
}

void TcpListener::unplug() {
    door_->shut();
    error_code ignored;
    if (driver_) driver_->close(ignored);
}

void TcpListener::reset() {
    if (driver_) close_with_reset(*driver_);
}

void TcpListener::forget() {
    if (!driver_) return;
    error_code ignored;
    forgotten_.push_back(driver_);
    driver_->cancel(ignored);
    driver_.reset();
}

void TcpListener::reset_forgotten() {
    for (const auto& driver : forgotten_) close_with_reset(*driver);
    forgotten_.clear();
}

void TcpListener::close() {
    closed_ = true;
    forgotten_.clear();
    last_answer_.cancel();
    error_code ignored;
    door_->close();
    if (driver_) driver_->close(ignored);
}

Wire TcpListener::wire() const {
    if (!driver_) return {Wire::Kind::tcp_server, door_->address(), {}};
    return ends_of(*driver_, Wire::Kind::tcp_server);
}

std::vector<std::string> TcpListener::connected() const {
    if (!driver_) return {};
    return {to_text(wire().remote)};
}

TcpClient::TcpClient(asio::io_context& io, std::string host, std::uint16_t port)
    : socket_(io), retry_(io), host_(std::move(host)), port_(port) {}

void TcpClient::start(Events events) {
    events_ = std::move(events);
    asio::co_spawn(socket_.get_executor(), keep_connected(), Serving(describe()));
}

Task<void> TcpClient::keep_connected() {
    error_code ec;
    while (!closing_) {
        Tcp::resolver resolver(socket_.get_executor());
        const auto found = co_await resolver.async_resolve(Tcp::v4(), host_, std::to_string(port_), into(ec));
        if (!ec && !unplugged_) co_await socket_.async_connect(*found.begin(), into(ec));
        if (!ec && !closing_ && !unplugged_) co_await read_stream();
        if (closing_) co_return;
        socket_.close(ec);
        retry_.expires_after(std::chrono::seconds(1));
        co_await retry_.async_wait(into(ec));
    }
}

Task<void> TcpClient::read_stream() {
    prepare(socket_);
    connected_ = true;
    events_.reconnected();
    const Address peer = ends_of(socket_, Wire::Kind::tcp_client).remote;
    events_.connected(peer);
    std::array<std::uint8_t, 4096> buffer;
    error_code ec;
    while (!ec) {
        const std::size_t n = co_await socket_.async_read_some(asio::buffer(buffer), into(ec));
        if (!ec) {
            count_in(n);
            events_.received(ByteView(buffer).first(n), {});
        }
    }
    connected_ = false;
    if (std::exchange(forgetting_, false)) {
        forgotten_.push_back(std::exchange(socket_, Tcp::socket(socket_.get_executor())));
    }
    if (!closing_) events_.disconnected(peer);
}

Task<void> TcpClient::write(ByteView bytes, Address) {
    if (!connected_) co_return;
    const std::size_t sent = co_await write_or_lose(socket_, bytes);
    count_out(sent);
    if (connected_) count_lost(bytes.size() - sent);
}

void TcpClient::hang_up(Address) {
    if (connected_) hang_up_on(socket_);
}

void TcpClient::unplug() {
    unplugged_ = true;
    error_code ignored;
    if (!forgetting_) socket_.close(ignored);
}

void TcpClient::plug() {
    unplugged_ = false;
    retry_.cancel();
}

void TcpClient::reset() {
    if (connected_) close_with_reset(socket_);
}

void TcpClient::reset_forgotten() {
    if (std::exchange(forgetting_, false)) close_with_reset(socket_);
    for (Tcp::socket& socket : forgotten_) close_with_reset(socket);
    forgotten_.clear();
}

void TcpClient::forget() {
    if (!connected_) return;
    error_code ignored;
    forgetting_ = true;
    socket_.cancel(ignored);
}

void TcpClient::close() {
    closing_ = true;
    error_code ignored;
    retry_.cancel(ignored);
    socket_.close(ignored);
}

std::string TcpClient::describe() const { return "tcp://" + host_ + ":" + std::to_string(port_); }

std::vector<std::string> TcpClient::connected() const {
    if (!connected_) return {};
    return {to_text(wire().remote)};
}

Wire TcpClient::wire() const { return ends_of(socket_, Wire::Kind::tcp_client); }

}  // namespace echoloop
