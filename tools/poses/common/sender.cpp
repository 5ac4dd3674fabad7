#include "tools/poses/common/sender.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "emulator/contract/error.h"
#include "tools/poses/common/say.h"
#include "tools/poses/common/stop.h"

namespace echoloop::poses {
namespace {

constexpr std::size_t longest_answer = 1 << 16;
constexpr int between_tries = 500;  // ms

std::int64_t steady_ms() {
    using namespace std::chrono;
    return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

sockaddr_in address_of(const Endpoint& endpoint) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(endpoint.port);
    address.sin_addr.s_addr = htonl(endpoint.ip);
    return address;
}

const sockaddr* plain(const sockaddr_in& address) { return reinterpret_cast<const sockaddr*>(&address); }

bool same(const sockaddr_in& a, const sockaddr_in& b) {
    return a.sin_addr.s_addr == b.sin_addr.s_addr && a.sin_port == b.sin_port;
}

bool ready(int socket, short what, int milliseconds) {
    pollfd wait{socket, what, 0};
    return ::poll(&wait, 1, milliseconds) > 0;
}

}  // namespace

Sender::Sender(const Endpoint& to)
    : to_(to), place_(to_string(to)), tcp_(to.scheme == Endpoint::Scheme::tcp) {
    if (tcp_) return;
    socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_port = htons(to.local_port());
    if (socket_ < 0 || ::bind(socket_, plain(own), sizeof own) != 0) {
        const std::string why = std::strerror(errno);
        throw StartError(Exit::unavailable, place_ + ": cannot open a socket: " + why);
    }
}

Sender::~Sender() {
    if (socket_ >= 0) ::close(socket_);
}

bool Sender::send(const std::string& line) { return write(line + "\n"); }

bool Sender::step(const std::string& line, Nanoseconds now) {
    constexpr double rounding = 1e-7;
    const double goal = static_cast<double>(now) * 1e-9 - rounding;
    error_.clear();
    while (!stopped()) {
        // A slow emulator may be at work on it for long. It does not lose lines with TCP, but may with UDP.
        const bool sent = write(line + "\n");
        for (bool again = sent; again && socket_ >= 0 && error_.empty() && !stopped(); again = tcp_) {
            if (answered(goal, 2 * between_tries)) return true;
            if (error_.empty() && !std::exchange(said_, true))
                say(place_ + " does not answer a step yet; an emulator with clock: {mode: stepped} would");
        }
        if (!error_.empty()) return complain();
        if (!sent) ::poll(nullptr, 0, between_tries);
    }
    return false;
}

/// Says what the emulator finds wrong, unless it said so last time.
bool Sender::complain() {
    if (said_error_ != error_) say(place_ + " answers: " + harmless(error_));
    said_error_ = error_;
    return false;
}

bool Sender::connect() {
    if (!tcp_ || socket_ >= 0) return socket_ >= 0;
    if (steady_ms() < retry_) return false;
    retry_ = steady_ms() + between_tries;
    const int made = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const auto address = address_of(to_);
    const int on = 1;
    int fault = 0;
    socklen_t size = sizeof fault;
    ::setsockopt(made, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    if (::connect(made, plain(address), sizeof address) != 0 && errno != EINPROGRESS) fault = errno;
    if (fault == 0 && !ready(made, POLLOUT, between_tries)) fault = ETIMEDOUT;
    if (fault == 0) ::getsockopt(made, SOL_SOCKET, SO_ERROR, &fault, &size);
    if (fault == 0) {
        socket_ = made;
        said_ = false;
        waiting_.clear();
        reached_ = -1;
        say("connected to " + place_);
        return true;
    }
    ::close(made);
    if (!std::exchange(said_, true))
        say(place_ + ": " + std::strerror(fault) + "; trying until an emulator listens there");
    return false;
}

void Sender::disconnect(const char* why) {
    say(place_ + ": " + why + "; trying to connect again");
    said_ = true;
    ::close(socket_);
    socket_ = -1;
}

bool Sender::write(const std::string& line) {
    if (!connect()) return false;
    const auto address = address_of(to_);
    if (!tcp_) return ::sendto(socket_, line.data(), line.size(), 0, plain(address), sizeof address) >= 0;
    for (std::size_t sent = 0; sent < line.size();) {
        const auto done = ::send(socket_, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
        if (done > 0) sent += static_cast<std::size_t>(done);
        if (done > 0 || errno == EINTR) continue;
        if (errno == EAGAIN && ready(socket_, POLLOUT, between_tries)) continue;
        disconnect(errno == EAGAIN ? "it reads nothing" : std::strerror(errno));
        return false;
    }
    answered(0, 0);  // so that answers nobody waits for do not pile up, and an end is seen
    return socket_ >= 0;
}

/// Reads until the emulator has got to `now`, or for that long at most.
bool Sender::answered(double now, int milliseconds) {
    const std::int64_t end = steady_ms() + milliseconds;
    while (socket_ >= 0 && !stopped()) {
        if (milliseconds > 0 && reached_ >= now) return true;
        if (milliseconds > 0 && !error_.empty()) return false;
        const auto left = std::max<std::int64_t>(0, end - steady_ms());
        if (!ready(socket_, POLLIN, static_cast<int>(left))) return false;
        std::array<char, 4096> bytes;
        sockaddr_in from{};
        socklen_t from_size = sizeof from;
        const auto size = ::recvfrom(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT,
                                     reinterpret_cast<sockaddr*>(&from), &from_size);
        const bool theirs = tcp_ || same(from, address_of(to_));
        if (size > 0 && theirs) take(bytes.data(), static_cast<std::size_t>(size));
        if (tcp_ && size == 0) disconnect("the emulator has closed the connection");
        if (size < 0 && errno != EAGAIN && errno != EINTR && tcp_) disconnect(std::strerror(errno));
    }
    return false;
}

void Sender::take(const char* bytes, std::size_t size) {
    waiting_.append(bytes, size);
    if (!tcp_ && waiting_.back() != '\n') waiting_ += '\n';
    std::size_t from = 0;
    for (std::size_t end; (end = waiting_.find('\n', from)) != std::string::npos; from = end + 1) {
        const auto answer =
            nlohmann::json::parse(waiting_.begin() + static_cast<std::ptrdiff_t>(from),
                                  waiting_.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
        if (!answer.is_object()) continue;
        if (answer.contains("error"))
            error_ = answer["error"].is_string() ? answer["error"].get<std::string>() : "an error";
        else if (answer.contains("now") && answer["now"].is_number())
            reached_ = answer["now"].get<double>();
    }
    waiting_.erase(0, from);
    if (waiting_.size() > longest_answer) waiting_.clear();
}

}  // namespace echoloop::poses
