// How far a data set is, on a terminal: while a free run makes its pings, and while the rest is written.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "emulator/dataset/dataset.h"
#include "tools/echoloop/terminal.h"

namespace echoloop::cli {

class DatasetProgress {
  public:
    /// `duration`: s of a run that goes as fast as it can; empty: of another, which shows nothing.
    DatasetProgress(const Dataset& dataset, std::optional<double> duration) {
        if (!duration || !(*duration > 0)) return;
        thread_ = std::jthread([this, &dataset, all = *duration](std::stop_token stop) {
            constexpr std::size_t steps = 1000;
            Progress progress("pinging", steps);
            std::mutex mutex;
            std::unique_lock lock(mutex);
            while (!ended_.wait_for(lock, stop, std::chrono::milliseconds(200), [] { return false; }) &&
                   !stop.stop_requested()) {
                const double part = to_seconds(dataset.summary().reached) / all;
                progress.done(
                    static_cast<std::size_t>(static_cast<double>(steps) * std::clamp(part, 0.0, 1.0)));
            }
        });
    }

  private:
    std::condition_variable_any ended_;
    std::jthread thread_;  // last: ends first
};

}  // namespace echoloop::cli
