#include "tools/echoloop/log.h"

#include <poll.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace echoloop::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// A pipe that has room has it for 4096 bytes at least (pipe(7)).
bool takes_a_line() {
    pollfd standard_error{STDERR_FILENO, POLLOUT, 0};
    return ::poll(&standard_error, 1, 0) == 1;  // an error as well, which writing does not wait for
}

/// Lets few lines of a kind through: what a peer causes as often as it likes must not fill a disk.
class FloodGate {
  public:
    /// How many lines of the kind of `text` were left out before it, or nothing if it is to be left out.
    std::optional<std::uint64_t> admit(std::string_view text, Clock::time_point now) {
        if (kinds_.size() >= most_kinds) kinds_.clear();
        Kind& kind = kinds_[without_digits(text)];
        if (now - kind.since > window) {
            kind.since = now;
            kind.said = 0;
        }
        if (kind.said < most_lines) {
            ++kind.said;
            return std::exchange(kind.left_out, 0);
        }
        ++kind.left_out;
        return std::nullopt;
    }
    /// Of all kinds, since they were told of.
    std::uint64_t left_out() {
        std::uint64_t sum = 0;
        for (auto& [text, kind] : kinds_) sum += std::exchange(kind.left_out, 0);
        return sum;
    }

  private:
    static constexpr std::chrono::seconds window{10};
    static constexpr unsigned most_lines = 10;
    static constexpr std::size_t most_kinds = 256;
    struct Kind {
        Clock::time_point since{};
        unsigned said = 0;
        std::uint64_t left_out = 0;
    };

    /// Lines of a kind differ in their numbers: ports, counts.
    static std::string without_digits(std::string_view text) {
        std::string kind(text);
        std::erase_if(kind, [](char c) { return c >= '0' && c <= '9'; });
        return kind;
    }

    std::unordered_map<std::string, Kind> kinds_;
};

class ImpatientSink final : public spdlog::sinks::base_sink<std::mutex> {
  public:
    ~ImpatientSink() override {
        if (const auto count = gate_.left_out(); count > 0 && takes_a_line()) tell_of_flood(count, {});
    }

  protected:
    void sink_it_(const spdlog::details::log_msg& message) override {
        const auto flood = gate_.admit({message.payload.data(), message.payload.size()}, Clock::now());
        if (!flood) return;
        if (!takes_a_line()) {
            ++left_out_;
            return;
        }
        if (left_out_ > 0) tell_what_was_left_out(message);
        if (*flood > 0) tell_of_flood(*flood, message.logger_name);
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

    void tell_of_flood(std::uint64_t count, spdlog::string_view_t logger) {
        const std::string text =
            std::to_string(count) + " more lines of a kind that came too often were left out";
        out_.log({logger, spdlog::level::warn, text});
    }

    spdlog::sinks::stderr_color_sink_st out_;
    FloodGate gate_;
    std::uint64_t left_out_ = 0;
};

}  // namespace

void log_to_stderr() { spdlog::default_logger()->sinks() = {std::make_shared<ImpatientSink>()}; }

}  // namespace echoloop::cli
