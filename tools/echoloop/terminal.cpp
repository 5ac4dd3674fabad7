#include "tools/echoloop/terminal.h"

#include <unistd.h>

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
    : label_(std::move(label)), steps_(steps), visible_(steps > 1 && ::isatty(STDERR_FILENO) == 1) {
    done(0);
}

Progress::~Progress() {
    if (visible_) std::fputs("\r\033[K", stderr);
}

void Progress::done(std::size_t steps) {
    constexpr std::size_t width = 40;
    const std::size_t filled = steps * width / steps_;
    if (!visible_ || filled == shown_) return;
    shown_ = filled;
    const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
    std::fprintf(stderr, "\r%s [%s] %zu/%zu", label_.c_str(), bar.c_str(), steps, steps_);
    std::fflush(stderr);
}

}  // namespace echoloop::cli
