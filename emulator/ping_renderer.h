// Has the pings of one sonar rendered, and the next one ahead of its time where that is known before. Knows
// no device and no message.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "emulator/asio.h"
#include "emulator/clock.h"
#include "emulator/device.h"
#include "emulator/render_thread.h"

namespace echoloop {

/// What a ping hears, once it is rendered.
struct Rendering {
    explicit Rendering(Clock& clock) : done(clock) {}
    std::optional<Echogram> echogram;
    Alarm done;
};

/// Belongs to the thread that runs the clock.
///
/// While a sonar pings on alike, its next ping is rendered as soon as the last one is, and so has a whole
/// interval for it instead of the way to the farthest echo and back. The bytes are the same: what was
/// rendered ahead is used only if the ping and everything that moves are just as they were expected.
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
    /// Behind it: the next one is expected to be like `ping`, which went out at `sent`. It is rendered ahead
    /// if that one was as expected.
    void expect_next(Ping ping, Time sent, bool objects);
    /// The sonar does not go on like that.
    void expect_nothing();
    /// What is still being rendered comes to nothing.
    void close() { *open_ = false; }

  private:
    RenderThread::Ticket submit(Time needed, Shot shot, Situation situation,
                                const std::shared_ptr<Rendering>& rendering);
    /// The ping after the last one.
    struct Expected {
        Shot shot;
        Situation situation;
        std::shared_ptr<Rendering> rendering{};  ///< nullptr: not asked for
        RenderThread::Ticket ticket{};
    };

    Clock& clock_;
    Inbox& inbox_;
    RenderThread& threads_;
    std::size_t sonar_;
    std::string name_;
    SituationAt situation_at_;  ///< empty: nobody knows
    std::optional<Expected> expected_;
    bool as_expected_ = false;                                   ///< the last ping was
    std::shared_ptr<bool> open_ = std::make_shared<bool>(true);  ///< read by what comes late
};

}  // namespace echoloop
