#include "emulator/transport/serial.h"

#include <libserialport.h>
#include <spdlog/spdlog.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "emulator/contract/error.h"
#include "emulator/transport/port_rate.h"

namespace echoloop {
namespace {

struct FreePort {
    void operator()(sp_port* port) const { sp_free_port(port); }
};
using PortHandle = std::unique_ptr<sp_port, FreePort>;

std::string last_reason() {
    const std::unique_ptr<char, void (*)(char*)> text(sp_last_error_message(), sp_free_error_message);
    return text ? text.get() : "unknown error";
}

constexpr auto other_ports =
    "; `ls /dev/serial/by-id` shows the ports there are. For a line without hardware use a pty: endpoint";

[[noreturn]] void fail(const std::string& path, const std::string& what) {
    const bool denied = errno == EACCES || errno == EPERM;
    const std::string remedy = denied ? "; join the group that owns the device (often dialout)" : other_ports;
    throw StartError(denied ? Exit::no_permission : Exit::unavailable,
                     "serial port " + path + ": " + what + ": " + last_reason() + remedy);
}

struct FreeList {
    void operator()(sp_port** list) const { sp_free_port_list(list); }
};

PortHandle find_port(const std::string& path) {
    sp_port* raw = nullptr;
    if (sp_get_port_by_name(path.c_str(), &raw) != SP_OK) {
        if (std::filesystem::exists(path))
            throw StartError(Exit::unavailable, path + ": is no serial port" + other_ports);
        fail(path, "cannot be found");
    }
    return PortHandle(raw);
}

void set_up(sp_port* port, const std::string& path, int baud) {
    if (sp_set_baudrate(port, baud) != SP_OK) fail(path, std::to_string(baud) + " baud cannot be set");
    if (sp_set_bits(port, 8) != SP_OK || sp_set_parity(port, SP_PARITY_NONE) != SP_OK ||
        sp_set_stopbits(port, 1) != SP_OK || sp_set_flowcontrol(port, SP_FLOWCONTROL_NONE) != SP_OK)
        fail(path, "8N1 without flow control cannot be set");
    sp_flush(port, SP_BUF_BOTH);
}

/// libserialport leaves reads that may return nothing, which asio takes for the end of the file.
void wait_for_a_byte(int fd) {
    termios settings{};
    if (::tcgetattr(fd, &settings) != 0) return;
    settings.c_cc[VMIN] = 1;
    settings.c_cc[VTIME] = 0;
    ::tcsetattr(fd, TCSANOW, &settings);
}

/// Opens the port and returns a descriptor of our own: libserialport configures, asio reads and writes.
int open_descriptor(const std::string& path, int baud) {
    const PortHandle port = find_port(path);
    if (sp_open(port.get(), SP_MODE_READ_WRITE) != SP_OK) fail(path, "cannot be opened");
    set_up(port.get(), path, baud);
    int fd = -1;
    if (sp_get_port_handle(port.get(), &fd) != SP_OK) fail(path, "has no descriptor");
    wait_for_a_byte(fd);
    const int own = ::dup(fd);
    sp_close(port.get());
    return own;
}

}  // namespace

std::vector<SerialPortName> serial_ports() {
    sp_port** raw = nullptr;
    if (sp_list_ports(&raw) != SP_OK) return {};
    const std::unique_ptr<sp_port*, FreeList> list(raw);
    std::vector<SerialPortName> names;
    for (sp_port** port = raw; *port; ++port) {
        const char* path = sp_get_port_name(*port);
        names.push_back({path, ::access(path, R_OK | W_OK) == 0});
    }
    return names;
}

SerialPort::SerialPort(asio::io_context& io, const std::string& path, int baud)
    : line_(io, open_descriptor(path, baud)), arrivals_(io), retry_(io), path_(path), baud_(baud) {}

void SerialPort::start(Events events) {
    events_ = std::move(events);
    asio::co_spawn(line_.get_executor(), keep_open(), Serving(describe()));
}

Task<void> SerialPort::keep_open() {
    while (!closed_) {
        const error_code gone = co_await read_line();
        if (closed_) co_return;
        spdlog::warn("serial port {}: unplugged ({}); this device goes on when {} is back", path_,
                     gone.message(), path_);
        error_code ignored;
        arrivals_.close();
        line_.close(ignored);
        co_await wait_for_return();
        if (closed_) co_return;
        spdlog::info("serial port {}: plugged in again", path_);
        events_.reconnected();
    }
}

Task<error_code> SerialPort::read_line() {
    std::array<std::uint8_t, 4096> buffer;  // a terminal holds fewer (N_TTY_BUF_SIZE): one read takes all
    arrivals_.watch(line_.native_handle());
    error_code ec;
    for (;;) {
        co_await arrivals_.wait(ec);
        if (ec) co_return ec;
        const ssize_t n = ::read(line_.native_handle(), buffer.data(), buffer.size());
        if (n == 0) co_return asio::error::eof;
        if (n < 0 && errno != EAGAIN) co_return error_code(errno, asio::error::get_system_category());
        if (n < 0) continue;
        count_in(static_cast<std::size_t>(n));
        events_.received(ByteView(buffer).first(static_cast<std::size_t>(n)), {});
    }
}

Task<void> SerialPort::wait_for_return() {
    constexpr std::chrono::milliseconds pause(500);
    while (!closed_ && !line_.is_open()) {
        error_code ec;
        retry_.expires_after(pause);
        co_await retry_.async_wait(into(ec));
        if (closed_ || ::access(path_.c_str(), R_OK | W_OK) != 0) continue;
        try {
            line_.assign(open_descriptor(path_, baud_));
        } catch (const StartError&) {  // not ready yet, or another's
        }
    }
}

Task<void> SerialPort::write(ByteView bytes, Address) {
    error_code ec;
    const double rate = asked_ > 0 ? asked_ : baud_;
    if (rate != baud_) co_await change_to(rate);
    if (line_.is_open())
        count_out(co_await asio::async_write(line_, asio::buffer(bytes.data(), bytes.size()), into(ec)));
    if (rate != baud_) co_await change_to(baud_);
}

Task<void> SerialPort::change_to(double rate) {
    constexpr std::chrono::milliseconds pause(1);
    asio::steady_timer timer(line_.get_executor());
    while (line_.is_open() && !has_sent_all(line_.native_handle())) {
        error_code ec;
        timer.expires_after(pause);
        co_await timer.async_wait(into(ec));
    }
    if (line_.is_open() && !change_rate(line_.native_handle(), rate))
        spdlog::warn("serial port {}: cannot change to {:.0f} bit/s: {}", path_, rate, std::strerror(errno));
}

void SerialPort::cut_off() {
    if (line_.is_open()) ::tcflush(line_.native_handle(), TCOFLUSH);
}

void SerialPort::close() {
    closed_ = true;
    error_code ignored;
    retry_.cancel(ignored);
    arrivals_.close();
    line_.close(ignored);
}

std::string SerialPort::describe() const { return "serial://" + path_ + ":" + std::to_string(baud_); }

}  // namespace echoloop
