// Moves a stepped clock as somebody outside says: takes lines in turn, poses as well as steps, and answers
// each step when everything that is due by then has been handed to the drivers. Opens nothing.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "emulator/clock/stepped_clock.h"
#include "emulator/pose/message.h"

namespace echoloop {

/// Where lines come from and answers go to.
class LineSource {
  public:
    virtual ~LineSource() = default;
    /// Its pose, or why there is none.
    virtual void take(const PoseText& text) = 0;
    /// `text` without the end of line. Lost if nobody is there any more.
    virtual Task<void> answer(std::string text, Address to, std::uint64_t connection) = 0;
};

struct StepSummary {
    std::uint64_t steps = 0, refused = 0;
    std::string last_refusal;
    Time run_time{};
};

class StepServer {
  public:
    static constexpr double most_ahead = 4 * 3600;       ///< s, in one step
    static constexpr std::size_t most_waiting = 100000;  ///< lines

    struct Line {
        PoseText text;
        LineSource* source = nullptr;
        Address from{};
        std::uint64_t connection = 0;  ///< of the source's
    };
    /// What each device has said so far, for the answers.
    using Sent = std::function<std::vector<std::pair<std::string, std::uint64_t>>()>;

    StepServer(SteppedClock& clock, Sent sent);

    /// `ended` is called when the run time `end` was reached and the step answered.
    void start(std::optional<Time> end, std::function<void()> ended);
    void close();
    void add(Line line);
    /// No more lines come: the run has ended when those that wait are served.
    void finish();
    StepSummary summary() const;

  private:
    Task<void> serve();
    Task<void> take(Line line);
    /// Why the clock cannot go there, "" if it can.
    std::string fault_of(double now) const;
    void refuse(const std::string& reason);
    std::string acknowledgement(double now) const;
    std::string error(const std::string& reason) const;

    SteppedClock& clock_;
    Sent sent_;
    std::deque<Line> lines_;
    Alarm bell_;                      ///< rings when there is a line
    std::optional<Time> end_, last_;  ///< last_: what the last step asked for
    std::function<void()> ended_;
    bool closed_ = false, finished_ = false;
    StepSummary summary_;
};

}  // namespace echoloop
