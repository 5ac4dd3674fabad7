#include "emulator/capture/background_file.h"

#include <spdlog/spdlog.h>

namespace echoloop {
BackgroundFile::BackgroundFile(std::filesystem::path file, std::string what, BackgroundFileLimits limits)
    : what_(std::move(what)), limits_(limits), path_(std::move(file)), file_(path_, "{\"") {
    thread_ = std::jthread([this](std::stop_token stop) { keep_writing(stop); });
}

BackgroundFile::~BackgroundFile() { finish(); }

void BackgroundFile::finish() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
    file_.close();
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
    take_no_signals_for_files();
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
    while (!lines.empty() && file_.is_open()) {
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
    if (const auto reason = file_.append(text, limits_.keep_free); !reason.empty()) return give_up(reason);
    const std::scoped_lock lock(mutex_);
    summary_.bytes += text.size();
    summary_.lines += lines;
}

void BackgroundFile::give_up(const std::string& reason) {
    spdlog::error(
        "{}: {} has stopped: {}; the emulation goes on. Make room and start again for a complete file",
        path_.string(), what_, reason);
    file_.close();
    const std::scoped_lock lock(mutex_);
    summary_.stopped = true;
    waiting_.clear();
}

}  // namespace echoloop
