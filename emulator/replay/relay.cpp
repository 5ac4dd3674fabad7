#include "emulator/replay/relay.h"

#include <deque>

#include "emulator/capture/recorded.h"
#include "emulator/clock/asio.h"
#include "emulator/contract/endpoint.h"
#include "emulator/transport/make.h"

namespace echoloop::replay {
namespace {

constexpr std::size_t most_waiting = std::size_t{8} << 20;  // bytes for a side that takes none

/// The bytes on their way to one side.
class Way {
  public:
    Way(asio::io_context& io, Transport& to, Address address) : to_(to), address_(address), mail_(io) {
        asio::co_spawn(io, keep_writing(), Serving("record"));
    }

    void send(ByteView bytes) {
        if (waiting_bytes_ + bytes.size() > most_waiting) {
            lost_ += bytes.size();
            return;
        }
        waiting_bytes_ += bytes.size();
        waiting_.emplace_back(bytes.begin(), bytes.end());
        mail_.cancel();
    }
    std::uint64_t lost() const { return lost_; }

  private:
    Task<void> keep_writing() {
        error_code ec;
        for (;;) {
            if (waiting_.empty()) {
                mail_.expires_at(std::chrono::steady_clock::time_point::max());
                co_await mail_.async_wait(into(ec));
                continue;
            }
            const Bytes bytes = std::move(waiting_.front());
            waiting_.pop_front();
            const std::uint64_t before = to_.bytes_out();
            co_await to_.write(bytes, address_);
            lost_ += bytes.size() - std::min<std::uint64_t>(bytes.size(), to_.bytes_out() - before);
            waiting_bytes_ -= bytes.size();
        }
    }

    Transport& to_;
    Address address_;
    asio::steady_timer mail_;
    std::deque<Bytes> waiting_;
    std::size_t waiting_bytes_ = 0;
    std::uint64_t lost_ = 0;
};

/// As the driver at its end has it.
std::unique_ptr<Transport> recorded(std::unique_ptr<Transport> line, Recording& recording,
                                    const std::string& name) {
    const auto interface = Recorded::add_interface(recording, *line, name);
    return std::make_unique<Recorded>(std::move(line), recording, interface, Recorded::Side::driver);
}

/// Where a datagram socket sends, whoever spoke to it last; zero for the others.
Address named_address(const std::string& uri) {
    const Endpoint endpoint = parse_endpoint(uri);
    if (endpoint.scheme != Endpoint::Scheme::udp) return {};
    return {endpoint.ip, endpoint.port};
}

}  // namespace

class Relay::Impl {
  public:
    Impl(RelaySettings settings, Recording& recording)
        : settings_(std::move(settings)),
          signals_(io_),
          end_(io_),
          device_(recorded(open_endpoint(io_, settings_.device, Browsers::served), recording,
                           settings_.name + " line")),
          driver_(open_endpoint(io_, settings_.driver, Browsers::served)),
          to_device_(io_, *device_, named_address(settings_.device)),
          to_driver_(io_, *driver_, named_address(settings_.driver)) {
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) signals_.add(signal);
    }

    void run() {
        signals_.async_wait([this](error_code ec, int) {
            if (!ec) stop();
        });
        if (settings_.duration) {
            end_.expires_after(std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                std::chrono::duration<double>(*settings_.duration)));
            end_.async_wait([this](error_code ec) {
                if (!ec) stop();
            });
        }
        join(*device_, to_driver_, *driver_);
        join(*driver_, to_device_, *device_);
        io_.run();
    }

    RelaySummary summary() const {
        return {device_->bytes_in(), driver_->bytes_in(), to_device_.lost() + to_driver_.lost()};
    }
    std::string device_place() const { return device_->describe(); }
    std::string driver_place() const { return driver_->describe(); }

  private:
    /// What `from` hears goes `way`; when it is left alone, the other end is, too.
    static void join(Transport& from, Way& way, Transport& other) {
        from.start({.received = [&way](ByteView bytes, Address) { way.send(bytes); },
                    .reconnected = [] {},
                    .disconnected = [&other](Address) { other.hang_up({}); }});
    }

    void stop() {
        device_->close();
        driver_->close();
        io_.stop();
    }

    RelaySettings settings_;
    asio::io_context io_;
    asio::signal_set signals_;
    asio::steady_timer end_;
    std::unique_ptr<Transport> device_, driver_;
    Way to_device_, to_driver_;
};

Relay::Relay(RelaySettings settings, Recording& recording)
    : impl_(std::make_unique<Impl>(std::move(settings), recording)) {}
Relay::~Relay() = default;
std::string Relay::device_place() const { return impl_->device_place(); }
std::string Relay::driver_place() const { return impl_->driver_place(); }
void Relay::run() { impl_->run(); }
RelaySummary Relay::summary() const { return impl_->summary(); }

}  // namespace echoloop::replay
