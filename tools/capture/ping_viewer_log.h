// The sensor logs of Ping Viewer, .bin: the frames that it received, with their times. Takes any bytes.
#pragma once

#include "tools/capture/capture.h"

namespace echoloop::capture {

class PingViewerLog final : public CaptureReader {
  public:
    static bool recognises(Input& input);
    /// Throws StartError (data) if its header cannot be read.
    explicit PingViewerLog(Input& input);

    std::optional<CaptureEvent> next() override;
    CaptureCounts counts() const override { return counts_; }

  private:
    std::optional<std::uint32_t> number();
    std::optional<std::string> text();
    std::optional<CaptureEvent> fail(const std::string& why);

    Input& input_;
    std::string line_;
    std::uint64_t at_ = 0;  ///< bytes read
    CaptureCounts counts_;
};

}  // namespace echoloop::capture
