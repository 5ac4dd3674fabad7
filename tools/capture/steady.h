// The events of a capture with times that never go back. The order of the file rules, and times give the
// gaps: a clock that was set back while the file was written makes no gap, and is counted.
#pragma once

#include <map>

#include "tools/capture/capture.h"

namespace echoloop::capture {

class Steady final : public CaptureReader {
  public:
    /// `input`: what the reader reads, and outlives this.
    Steady(std::unique_ptr<CaptureReader> reader, const Input& input)
        : reader_(std::move(reader)), input_(input) {}

    std::optional<CaptureEvent> next() override;
    CaptureCounts counts() const override;
    bool of_ports() const override { return reader_->of_ports(); }

  private:
    void note_step(const CaptureEvent& event, double step);

    std::unique_ptr<CaptureReader> reader_;
    const Input& input_;
    struct Clock {
        double lag = 0;                ///< s, that it was behind the others when it came first
        double last = 0;               ///< s, with lag and what was added
        std::uint64_t steps = 0;       ///< counted until then
        std::optional<double> late{};  ///< time of the first of those in a row that were late
        int late_ones = 0;
    };
    /// Of each interface or sort of message; what comes by one of them may be written later than by another.
    std::map<std::pair<std::string, std::string>, Clock> clocks_;
    double added_ = 0;  ///< s, all steps so far
    std::optional<double> said_{};
    std::uint64_t events_ = 0;
    CaptureCounts steps_;
};

/// "the clock of the file steps back by 2.8 s at packet 11, and 2 times more; no gap is made of it"; "" if it
/// never does.
std::string step_text(const CaptureCounts& counts);

}  // namespace echoloop::capture
