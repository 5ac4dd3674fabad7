#include "tools/echoloop/terminal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace echoloop::cli {

bool coloured(int descriptor) {
    const char* no_colour = std::getenv("NO_COLOR");
    return (no_colour == nullptr || *no_colour == '\0') && ::isatty(descriptor) == 1;
}

namespace {

void print(std::string_view kind, const char* colour, std::string_view text) {
    while (!text.empty()) {
        const auto line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        std::string out = "echoloop: ";
        out += coloured(STDERR_FILENO) ? colour + std::string(kind) + "\033[0m" : std::string(kind);
        out += ": " + std::string(line) + "\n";
        std::fwrite(out.data(), 1, out.size(), stderr);
    }
}

}  // namespace

void print_error(std::string_view text) { print("error", "\033[1;31m", text); }
void print_warning(std::string_view text) { print("warning", "\033[1;33m", text); }

Progress::Progress(std::string label, std::size_t steps)
    : label_(std::move(label)),
      steps_(steps),
      terminal_(::isatty(STDERR_FILENO) == 1 ? ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3) : -1) {
    done(0);
}

Progress::~Progress() {
    clear();
    if (terminal_ >= 0) ::close(terminal_);
}

void Progress::clear() {
    if (terminal_ < 0 || shown_.empty()) return;
    (void)!::write(terminal_, "\r\033[K", 4);
    shown_.clear(), last_ = {};
}

void Progress::done(std::size_t steps, std::size_t of) {
    steps_ = of;
    done(steps);
}

/// ", 40 s left" as soon as that can be told.
std::string Progress::rest(std::size_t steps) const {
    const double passed = std::chrono::duration<double>(last_ - begun_).count();
    if (passed < 2 || steps == 0 || steps >= steps_) return {};
    const double left = passed * static_cast<double>(steps_ - steps) / static_cast<double>(steps);
    return left < 90 ? ", " + std::to_string(std::lround(left)) + " s left"
                     : ", " + std::to_string(std::lround(left / 60)) + " min left";
}

void Progress::done(std::size_t steps) {
    constexpr std::size_t width = 40, most_to_count = 99'999;
    constexpr auto between = std::chrono::milliseconds(100);
    if (terminal_ < 0 || steps_ < 2) return;
    steps = std::min(steps, steps_);
    const auto now = std::chrono::steady_clock::now();
    if (now < last_ + between && steps < steps_) return;
    last_ = now;
    const std::size_t filled = steps * width / steps_;
    std::string text =
        "\r" + label_ + " [" + std::string(filled, '#') + std::string(width - filled, '.') + "] ";
    text += steps_ <= most_to_count ? std::to_string(steps) + "/" + std::to_string(steps_)
                                    : std::to_string(steps * 100 / steps_) + " %";
    text += rest(steps) + "\033[K";
    if (text == shown_) return;
    (void)!::write(terminal_, text.data(), text.size());
    shown_ = text;
}

}  // namespace echoloop::cli
