#include "emulator/dataset/dataset.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

#include "emulator/contract/error.h"
#include "emulator/dataset/writer.h"

namespace echoloop {
namespace {

const std::filesystem::path& not_there(const std::filesystem::path& folder) {
    std::error_code error;
    if (std::filesystem::exists(folder, error))
        throw StartError(Exit::cannot_create, folder.string() +
                                                  ": exists already, and a data set is made as a whole; "
                                                  "name another folder, or remove this one");
    return folder;
}

}  // namespace

Dataset::Dataset(const std::filesystem::path& folder, DatasetLimits limits)
    : aside_(not_there(folder)), limits_(limits), place_(aside_.path(), limits.keep_free) {
    if (!aside_.mine())
        throw StartError(Exit::late, aside_.whole().string() +
                                         ": another run is making this data set; name another folder");
}

Dataset::~Dataset() {
    {
        const std::scoped_lock lock(mutex_);
        waiting_.clear();
    }
    if (thread_.joinable()) thread_.request_stop(), thread_.join();
}

void Dataset::begin(DatasetStart start) {
    waits_ = start.waits;
    left_out_.assign(start.turns.size(), 1);
    failed_ = start.failed;
    thread_ = std::jthread([this, first = std::move(start)](std::stop_token stop) mutable {
        take_no_signals_for_files();
        try {
            writer_ = std::make_unique<DatasetWriter>(place_, std::move(first));
        } catch (const std::exception& error) {
            fail(error.what());
        }
        keep_writing(stop);
    });
}

void Dataset::forget_run() {
    const std::scoped_lock lock(mutex_);
    failed_ = nullptr;
}

void Dataset::heard(std::size_t sonar, PingTruth ping) {
    const std::size_t bytes = sizeof ping + ping.echo.values.size() * (sizeof(float) + sizeof(std::uint16_t));
    {
        const std::scoped_lock lock(mutex_);
        summary_.reached = ping.transmitted;
    }
    const auto kept = std::make_shared<PingTruth>(std::move(ping));
    left_out_[sonar] =
        !add(bytes, true, [sonar, kept](DatasetWriter& writer) { writer.heard(sonar, std::move(*kept)); });
}

void Dataset::said(std::size_t sonar, std::size_t port, std::string_view bytes) {
    if (left_out_[sonar]) return;
    add(bytes.size(), false,
        [sonar, port, kept = std::string(bytes)](DatasetWriter& writer) { writer.said(sonar, port, kept); });
}

bool Dataset::add(std::size_t bytes, bool may_be_left_out, Work work) {
    std::unique_lock lock(mutex_);
    const auto full = [&] {
        return may_be_left_out && !summary_.stopped && waiting_bytes_ > 0 &&
               waiting_bytes_ + bytes > limits_.most_waiting;
    };
    if (waits_) room_.wait(lock, [&] { return !full(); });
    if (summary_.stopped) return false;
    if (full()) {
        if (summary_.lost++ == 0)
            spdlog::warn(
                "{}: writing is slower than the sonars; pings are left out, and the end of the run says how "
                "many",
                aside_.whole().string());
        return false;
    }
    waiting_bytes_ += bytes;
    summary_.pings += may_be_left_out;
    waiting_.push_back({bytes, std::move(work)});
    more_.notify_one();
    return true;
}

void Dataset::keep_writing(std::stop_token stop) {
    while (true) {
        std::unique_lock lock(mutex_);
        more_.wait(lock, stop, [this] { return !waiting_.empty(); });
        if (waiting_.empty()) return;  // only at the end
        Waiting next = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        try {
            if (writer_) next.work(*writer_);
        } catch (const std::exception& error) {
            fail(error.what());
        }
        lock.lock();
        waiting_bytes_ -= std::min(next.bytes, waiting_bytes_);  // only now: it holds memory until then
        summary_.bytes = place_.bytes();
        room_.notify_all();
    }
}

void Dataset::fail(const std::string& why) {
    writer_.reset();
    spdlog::error("{}: the data set has stopped: {}", aside_.whole().string(), why);
    const std::scoped_lock lock(mutex_);
    if (summary_.stopped) return;
    summary_.stopped = true;
    fault_ = why;
    waiting_.clear();
    waiting_bytes_ = 0;
    if (failed_) failed_();
}

/// Until nothing waits.
void Dataset::tell_rest(const Told& told) {
    constexpr auto between = std::chrono::milliseconds(100);
    std::unique_lock lock(mutex_);
    for (const std::size_t all = waiting_.size(); !waiting_.empty(); room_.wait_for(lock, between)) {
        const std::size_t done = all - std::min(all, waiting_.size());
        lock.unlock();
        told(done, all);
        lock.lock();
    }
}

void Dataset::finish(const Told& told) {
    add(0, false, [lost = summary().lost](DatasetWriter& writer) { writer.finish(lost); });
    if (told && thread_.joinable()) tell_rest(told);
    if (thread_.joinable()) thread_.request_stop(), thread_.join();
    writer_.reset();
    if (!fault_.empty())
        throw StartError(Exit::io, fault_ + "; make room on that disk and start again: nothing is kept of " +
                                       aside_.whole().string());
    summary_.bytes = place_.bytes();
    aside_.finish();
}

DatasetSummary Dataset::summary() const {
    const std::scoped_lock lock(mutex_);
    return summary_;
}

}  // namespace echoloop
