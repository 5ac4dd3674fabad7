#include "emulator/capture/background_file.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>

#include "emulator/error.h"

namespace echoloop {
namespace {

constexpr std::size_t enough_to_write = 1 << 20;
constexpr std::chrono::milliseconds longest_wait(500);  // what a kill -9 may lose

/// False with errno set if the disk takes no more.
bool write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t n = ::write(descriptor, text.data(), text.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        text.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
}

}  // namespace

BackgroundFile::BackgroundFile(std::filesystem::path file, std::string what, BackgroundFileLimits limits)
    : file_(std::move(file)),
      what_(std::move(what)),
      limits_(limits),
      descriptor_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0)
        throw StartError(Exit::cannot_create, file_.string() +
                                                  ": cannot be written: " + std::strerror(errno) +
                                                  "; name a file in a folder that you may write to");
    thread_ = std::jthread([this](std::stop_token stop) { keep_writing(stop); });
}

BackgroundFile::~BackgroundFile() { finish(); }

void BackgroundFile::finish() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
}

void BackgroundFile::add(std::size_t bytes, Write write) {
    const std::scoped_lock lock(mutex_);
    if (summary_.stopped) return;
    if (waiting_bytes_ + bytes > limits_.most_waiting) {
        ++summary_.lost;
        return;
    }
    waiting_.push_back({bytes, std::move(write)});
    waiting_bytes_ += bytes;
    if (waiting_bytes_ >= enough_to_write) more_.notify_one();
}

void BackgroundFile::add(std::string line) {
    const std::size_t bytes = line.size();
    add(bytes, [line = std::move(line)](std::string& text) { text += line; });
}

BackgroundFileSummary BackgroundFile::summary() const {
    const std::scoped_lock lock(mutex_);
    return summary_;
}

void BackgroundFile::keep_writing(std::stop_token stop) {
    bool last = false;
    while (!last) {
        std::deque<Line> lines;
        {
            std::unique_lock lock(mutex_);
            more_.wait_for(lock, stop, longest_wait, [this] { return waiting_bytes_ >= enough_to_write; });
            last = stop.stop_requested();
            lines.swap(waiting_);
        }
        write(lines);
    }
}

void BackgroundFile::write(std::deque<Line>& lines) {
    std::string text;
    while (!lines.empty() && descriptor_ >= 0) {
        text.clear();
        std::size_t held = 0;
        std::uint64_t count = 0;
        for (; !lines.empty() && text.size() < enough_to_write; lines.pop_front(), ++count) {
            lines.front().write(text);
            text += '\n';
            held += lines.front().bytes;
        }
        write(text, count);
        const std::scoped_lock lock(mutex_);
        waiting_bytes_ -= held;  // only now: what is being written holds memory too
    }
}

void BackgroundFile::write(const std::string& text, std::uint64_t lines) {
    std::error_code ec;
    const auto space = std::filesystem::space(std::filesystem::absolute(file_).parent_path(), ec);
    if (!ec && space.available < limits_.keep_free + text.size()) return give_up("the disk is nearly full");
    if (!write_all(descriptor_, text)) {
        const std::string reason = std::strerror(errno);
        // Half a line would make the whole file suspect.
        if (::ftruncate(descriptor_, static_cast<off_t>(summary().bytes)) != 0)
            spdlog::debug("{} has a cut end", file_.string());
        return give_up(reason);
    }
    const std::scoped_lock lock(mutex_);
    summary_.bytes += text.size();
    summary_.lines += lines;
}

void BackgroundFile::give_up(const std::string& reason) {
    spdlog::error("{}: {} has stopped: {}; the emulation goes on. Make room and start again to have it whole",
                  file_.string(), what_, reason);
    ::close(descriptor_);
    descriptor_ = -1;
    const std::scoped_lock lock(mutex_);
    summary_.stopped = true;
    waiting_.clear();
}

}  // namespace echoloop
