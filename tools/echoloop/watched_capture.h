// A capture whose reading shows on a terminal. Changes nothing of what is read.
#pragma once

#include <memory>
#include <utility>

#include "tools/capture/capture.h"
#include "tools/echoloop/terminal.h"

namespace echoloop::cli {

class WatchedCapture : public capture::CaptureReader {
  public:
    /// `input`, which outlives it, is what `reader` reads.
    WatchedCapture(const capture::Input& input, std::unique_ptr<capture::CaptureReader> reader)
        : input_(input), reader_(std::move(reader)), progress_("reading", input.size()) {}

    std::optional<capture::CaptureEvent> next() override {
        constexpr unsigned now_and_then = 256;
        if (count_++ % now_and_then == 0) progress_.done(input_.offset());
        auto event = reader_->next();
        if (!event) {
            progress_.done(input_.size());
            progress_.clear();  // warnings may follow
        }
        return event;
    }
    capture::CaptureCounts counts() const override { return reader_->counts(); }
    bool of_ports() const override { return reader_->of_ports(); }

  private:
    const capture::Input& input_;
    std::unique_ptr<capture::CaptureReader> reader_;
    Progress progress_;
    unsigned count_ = 0;
};

}  // namespace echoloop::cli
