// Logs of a serial line as text: one stretch of bytes a line, its time in seconds, who said it, the bytes in
// hexadecimal digits. Takes any bytes.
#pragma once

#include "tools/capture/capture.h"

namespace echoloop::capture {

/// "12.345 < 40 30 30 33" or "12.345 > 4030": from the device or to it; without a mark from it. Empty lines
/// and what follows '#' are passed over.
class SerialLog final : public CaptureReader {
  public:
    static bool recognises(Input& input);
    explicit SerialLog(Input& input) : input_(input) {}

    std::optional<CaptureEvent> next() override;
    CaptureCounts counts() const override { return counts_; }

  private:
    std::optional<std::string> line();

    Input& input_;
    std::string text_;    ///< read
    std::size_t at_ = 0;  ///< of the next line in it
    std::size_t number_ = 0;
    CaptureCounts counts_;
};

}  // namespace echoloop::capture
