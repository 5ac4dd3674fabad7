// A file of a device's messages back to back, as makers and drivers write them (.852, .81A, .31l, .svlog,
// .sonar, .83P, raw streams), as if they came over a line. Takes any bytes.
#pragma once

#include <deque>

#include "protocols/stream_decoder.h"
#include "tools/capture/open.h"

namespace echoloop::capture {

class MessageFile final : public CaptureReader {
  public:
    /// The family that the file's first bytes belong to; nullptr if none.
    static const inspect::Family* recognise(Input& input);

    /// By the times that the messages hold, unless the settings give an interval. One without a time follows
    /// at once.
    MessageFile(Input& input, const inspect::Family& family, const OpenSettings& settings);

    std::optional<CaptureEvent> next() override;
    CaptureCounts counts() const override { return counts_; }

  private:
    void keep(const inspect::Message& message, ByteView bytes);

    Input& input_;
    std::string line_;
    OpenSettings settings_;
    inspect::StreamDecoder decoder_;
    std::deque<CaptureEvent> waiting_;
    double time_ = 0;
    bool ended_ = false;
    CaptureCounts counts_;
};

}  // namespace echoloop::capture
