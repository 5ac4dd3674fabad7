#include "tools/echoloop/log.h"

#include <poll.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace echoloop::cli {
namespace {

/// A pipe that has room has it for 4096 bytes at least (pipe(7)).
bool takes_a_line() {
    pollfd standard_error{STDERR_FILENO, POLLOUT, 0};
    return ::poll(&standard_error, 1, 0) == 1;  // an error as well, which writing does not wait for
}

class ImpatientSink final : public spdlog::sinks::base_sink<std::mutex> {
  protected:
    void sink_it_(const spdlog::details::log_msg& message) override {
        if (!takes_a_line()) {
            ++left_out_;
            return;
        }
        if (left_out_ > 0) tell_what_was_left_out(message);
        out_.log(message);
    }
    void flush_() override { out_.flush(); }

  private:
    void tell_what_was_left_out(const spdlog::details::log_msg& next) {
        const std::string text =
            std::to_string(left_out_) + " lines of the log were left out, as nobody read them";
        left_out_ = 0;
        out_.log({next.logger_name, spdlog::level::warn, text});
    }

    spdlog::sinks::stderr_color_sink_st out_;
    std::uint64_t left_out_ = 0;
};

}  // namespace

void log_to_stderr() { spdlog::default_logger()->sinks() = {std::make_shared<ImpatientSink>()}; }

}  // namespace echoloop::cli
