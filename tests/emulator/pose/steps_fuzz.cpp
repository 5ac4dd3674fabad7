// libFuzzer: any bytes to the place that steps a clock, as lines in pieces, or in one burst. Each line gets
// one answer of one line of JSON, time never goes back, and never further than a step may go.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "emulator/pose/lines.h"
#include "emulator/pose/step_server.h"
#include "emulator/transport/web_request.h"

using namespace echoloop;

namespace {

void require(bool good) {
    if (!good) std::abort();
}

class Steps final : LineSource {
  public:
    /// What has come when the connection ends.
    void serve(ByteView bytes, std::size_t piece) {
        server_.start({}, [this] { io_.stop(); });
        for (; !bytes.empty() && !web_.is_begun_by(bytes.first(std::min(piece, bytes.size())));
             bytes = bytes.subspan(std::min(piece, bytes.size())))
            lines_.feed(bytes.first(std::min(piece, bytes.size())),
                        [this](std::string_view line) { add(line); });
        server_.finish();
        clock_.run();
        const StepSummary summary = server_.summary();
        require(taken_ == added_ && answers_ >= summary.steps + summary.refused && answers_ <= added_);
    }

  private:
    void add(std::string_view line) {
        PoseText read{{}, "the line is longer than 4096 bytes", {}};
        if (!line.empty()) read = parse_pose_line(line);
        server_.add({std::move(read), this, {}, 1});
        ++added_;
    }
    void take(const PoseText& text) override {
        require(clock_.now() >= before_);
        before_ = clock_.now();
        ++taken_;
        require(text.reason.empty() || !text.message);
    }
    Task<void> answer(std::string text, Address, std::uint64_t) override {
        ++answers_;
        const auto json = nlohmann::json::parse(text, nullptr, false);
        require(json.is_object() && json.contains("error") != json.contains("sent"));
        require(text.find('\n') == std::string::npos);
        require(to_seconds(clock_.now() - before_) <= StepServer::most_ahead + 1e-6);
        co_return;
    }

    asio::io_context io_;
    SteppedClock clock_{io_};
    StepServer server_{clock_, [] { return std::vector<std::pair<std::string, std::uint64_t>>{{"a", 7}}; }};
    Lines lines_;
    WebRequest web_;
    Time before_{};
    std::size_t added_ = 0, taken_ = 0, answers_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    Steps().serve({data + 1, size - 1}, data[0] + 1U);
    return 0;
}
