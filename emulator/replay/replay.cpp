#include "emulator/replay/replay.h"

#include <unistd.h>

#include <algorithm>
#include <deque>

#include "emulator/capture/watched.h"
#include "emulator/clock/clock.h"
#include "emulator/contract/endpoint.h"
#include "emulator/replay/standard_input.h"
#include "emulator/transport/make.h"
#include "emulator/transport/paced.h"

namespace echoloop::replay {
namespace {

using Scheme = Endpoint::Scheme;

/// Who opens a line flushes it next, as tcsetattr(TCSAFLUSH) and many drivers do; what was said meanwhile is
/// lost.
constexpr std::chrono::milliseconds grace(100);
/// A pty that goes away takes along what its driver has not read yet.
constexpr std::chrono::milliseconds farewell(500);

/// A message may be empty and takes some all the same.
std::size_t memory_of(const Bytes& bytes) { return bytes.size() + 100; }

bool waits_for_driver(const Place& place) {
    const Scheme scheme = parse_endpoint(place.endpoint).scheme;
    return scheme != Scheme::udp && scheme != Scheme::serial;
}

bool is_pty(const Place& place) { return parse_endpoint(place.endpoint).scheme == Scheme::pty; }

std::unique_ptr<Transport> open_line(Clock& clock, const Place& place) {
    Endpoint endpoint = parse_endpoint(place.endpoint);
    const bool uart = endpoint.scheme == Scheme::serial;
    if (uart && endpoint.baud == 0) endpoint.baud = static_cast<std::uint32_t>(place.baud);
    auto line = open_endpoint(clock.io(), to_string(endpoint), Browsers::served);
    if (uart || place.baud <= 0) return line;
    return std::make_unique<Paced>(clock, std::move(line), place.baud);
}

std::unique_ptr<Transport> open_place(Clock& clock, const Place& place, Watch* watch) {
    auto line = open_line(clock, place);
    if (watch == nullptr) return line;
    return std::make_unique<Watched>(std::move(line), *watch, place.name, "");
}

}  // namespace

class Replay::Impl {
  public:
    Impl(std::unique_ptr<Player> player, Settings settings)
        : player_(std::move(player)),
          settings_(std::move(settings)),
          clock_(io_),
          signals_(io_),
          alarm_(clock_),
          grace_(clock_),
          end_(io_) {
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) signals_.add(signal);
        for (const Place& place : settings_.places)
            lines_.emplace_back(clock_, open_place(clock_, place, settings_.watch));
        if (settings_.steps_by_lines)
            lines_of_input_.emplace(io_, [this] {
                player_->stepped(now());
                wake();
            });
    }

    std::vector<std::string> places() const {
        std::vector<std::string> all;
        for (const Line& line : lines_) all.push_back(line.transport->describe());
        return all;
    }

    void run() {
        signals_.async_wait([this](error_code ec, int) {
            if (!ec) stop();
        });
        if (settings_.duration) end_after(std::chrono::duration<double>(*settings_.duration));
        clock_.begin();
        for (std::size_t port = 0; port < lines_.size(); ++port) start_line(port);
        const bool all_wait = std::ranges::all_of(settings_.places, waits_for_driver);
        if (settings_.starts_at_once || !all_wait) arrived(false);
        if (lines_of_input_) lines_of_input_->start();
        asio::co_spawn(io_, keep_playing(), Serving("replay"));
        clock_.run();
        if (arrived_) summary_.seconds = to_seconds(now() - *arrived_);
    }

    Summary summary() const {
        Summary s = summary_;
        for (const Line& line : lines_) {
            s.taken += line.transport->bytes_out();
            s.bytes_in += line.transport->bytes_in();
        }
        return s;
    }
    const PlayerCounts& counts() const { return player_->counts(); }

  private:
    /// What waits for one endpoint, so that a slow one delays no other.
    struct Line {
        Line(Clock& clock, std::unique_ptr<Transport> open) : transport(std::move(open)), mail(clock) {}
        std::unique_ptr<Transport> transport;
        std::deque<std::pair<Bytes, Time>> waiting;  ///< and when they are due
        std::size_t memory = 0;                      ///< of all that waits
        bool writing = false;
        Alarm mail;
    };

    Time now() const { return clock_.now(); }

    void start_line(std::size_t port) {
        lines_[port].transport->start({.received =
                                           [this, port](ByteView bytes, Address) {
                                               arrived(true);
                                               player_->heard(port, bytes, now());
                                               wake();
                                           },
                                       .reconnected = [this, port] { player_->reconnected(port); },
                                       .connected = [this](Address) { arrived(true); },
                                       .opened = [this] { opened(); }});
        asio::co_spawn(io_, keep_writing(lines_[port]), Serving("replay"));
    }

    void opened() {
        summary_.driver_came = true;
        if (!arrived_ && !std::exchange(opened_, true))
            asio::co_spawn(io_, arrive_after_grace(), Serving("replay"));
    }

    Task<void> arrive_after_grace() {
        co_await grace_.until(now() + grace);
        if (!stopped_) arrived(true);
    }

    void arrived(bool driver) {
        summary_.driver_came |= driver;
        if (arrived_) return;
        arrived_ = now();
        player_->arrived(*arrived_);
        wake();
    }

    void wake() { alarm_.cancel(); }

    Task<void> keep_playing() {
        constexpr std::size_t most_waiting = std::size_t{8} << 20;
        while (!stopped_ && !player_->ended()) {
            const auto due = player_->due();
            const bool full =
                std::ranges::any_of(lines_, [](const Line& l) { return l.memory > most_waiting; });
            if (due && *due <= now() && !full) {
                hand_over(player_->take(), *due);
                continue;
            }
            co_await alarm_.until(due && !full ? *due : Time::max());
        }
        while (!stopped_ &&
               std::ranges::any_of(lines_, [](const Line& l) { return l.memory > 0 || l.writing; })) {
            co_await alarm_.until(Time::max());
        }
        const bool lingers = summary_.messages > 0 && std::ranges::any_of(settings_.places, is_pty);
        if (!stopped_)
            end_after(lingers ? std::chrono::duration<double>(farewell) : std::chrono::duration<double>(0));
    }

    void hand_over(Outgoing out, Time due) {
        if (out.port >= lines_.size()) return;
        Line& line = lines_[out.port];
        ++summary_.messages;
        summary_.bytes += out.bytes.size();
        line.memory += memory_of(out.bytes);
        line.waiting.emplace_back(std::move(out.bytes), due);
        line.mail.cancel();
    }

    Task<void> keep_writing(Line& line) {
        while (!stopped_) {
            if (line.waiting.empty()) {
                co_await line.mail.until(Time::max());
                continue;
            }
            const auto [bytes, due] = std::move(line.waiting.front());
            line.waiting.pop_front();
            line.writing = true;
            summary_.worst_lateness = std::max(summary_.worst_lateness, now() - due);
            co_await line.transport->write(bytes, {});
            line.writing = false;
            line.memory -= memory_of(bytes);
            wake();
        }
    }

    void end_after(std::chrono::duration<double> time) {
        end_.expires_after(std::chrono::duration_cast<std::chrono::steady_clock::duration>(time));
        end_.async_wait([this](error_code ec) {
            if (!ec) stop();
        });
    }

    void stop() {
        stopped_ = true;
        for (Line& line : lines_) line.transport->close();
        io_.stop();
    }

    std::unique_ptr<Player> player_;
    Settings settings_;
    asio::io_context io_;
    RealClock clock_;
    asio::signal_set signals_;
    Alarm alarm_;  ///< rings when something is due
    Alarm grace_;  ///< rings when who has opened a line is ready
    asio::steady_timer end_;
    std::deque<Line> lines_;
    std::optional<StandardInput> lines_of_input_;
    bool opened_ = false;
    std::optional<Time> arrived_;
    Summary summary_;
    bool stopped_ = false;
};

Replay::Replay(std::unique_ptr<Player> player, Settings settings)
    : impl_(std::make_unique<Impl>(std::move(player), std::move(settings))) {}
Replay::~Replay() = default;
std::vector<std::string> Replay::places() const { return impl_->places(); }
void Replay::run() { impl_->run(); }
Summary Replay::summary() const { return impl_->summary(); }
const PlayerCounts& Replay::counts() const { return impl_->counts(); }

}  // namespace echoloop::replay
