// Has the pings of one sonar rendered, and the next ones ahead of their time where these are known before.
// Knows no device and no message.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "emulator/clock/asio.h"
#include "emulator/clock/clock.h"
#include "emulator/contract/device.h"
#include "emulator/water/render_thread.h"

namespace echoloop {

/// What a ping hears, once it is rendered.
struct Rendering {
    explicit Rendering(Clock& clock) : done(clock) {}
    std::optional<Echogram> echogram;
    Alarm done;
};

/// Belongs to the thread that runs the clock.
///
/// While a sonar pings on alike, its next pings are rendered ahead: they have intervals for it instead of the
/// way to the farthest echo and back, and a machine that is busy for a moment makes none of them late. The
/// bytes are the same: what was rendered ahead is used only if the ping and everything that moves are just as
/// they were expected.
class PingRenderer {
  public:
    /// Where the sonar and everything that moves will be at a time to come.
    using SituationAt = std::function<Situation(Time)>;

    PingRenderer(Clock& clock, RenderThread& threads, std::size_t sonar, std::string name)
        : clock_(clock), inbox_(clock.inbox()), threads_(threads), sonar_(sonar), name_(std::move(name)) {}
    ~PingRenderer() { close(); }
    PingRenderer(const PingRenderer&) = delete;
    PingRenderer& operator=(const PingRenderer&) = delete;

    /// From now on pings are rendered ahead.
    void look_ahead(SituationAt situation_at) { situation_at_ = std::move(situation_at); }

    std::shared_ptr<Rendering> render(Time needed, Shot shot, Situation situation);
    /// The same for a ping that goes out now.
    std::shared_ptr<Rendering> render(const Ping& ping, const Situation& situation);
    /// Behind it: the next ones are expected to be like `ping`, which went out at `sent`. They are rendered
    /// ahead if that one was as expected, the more of them the more pings before it were.
    void expect_next(Ping ping, Time sent, bool objects);
    /// The sonar does not go on like that.
    void expect_nothing();
    /// What is still being rendered comes to nothing.
    void close() { *open_ = false; }

  private:
    RenderThread::Ticket submit(RenderThread::Claim claim, Shot shot, Situation situation,
                                const std::shared_ptr<Rendering>& rendering);
    /// A ping after the last one.
    struct Expected {
        Ping ping;
        Time sent;
        Situation situation;
        std::shared_ptr<Rendering> rendering{};  ///< nullptr: not asked for
        RenderThread::Ticket ticket{};

        bool is(const Shot& shot, const Situation& other) const {
            return ping.shot == shot && situation == other;
        }
    };
    Expected after(Ping ping, Time sent, bool objects) const;
    /// How many pings like that one are worth it to be expected now.
    std::size_t pings_ahead(const Shot& shot) const;
    void withdraw_all();

    Clock& clock_;
    Inbox& inbox_;
    RenderThread& threads_;
    std::size_t sonar_;
    std::string name_;
    SituationAt situation_at_;                                   ///< empty: nobody knows
    std::deque<Expected> expected_;                              ///< one after the other
    std::size_t as_expected_ = 0;                                ///< so many pings in a row were
    std::shared_ptr<bool> open_ = std::make_shared<bool>(true);  ///< read by what comes late
};

}  // namespace echoloop
