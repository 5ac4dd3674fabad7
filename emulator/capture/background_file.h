// A file of JSON lines that a thread of its own writes, within half a second: a slow disk delays nobody, a
// full one ends the file and never the emulation. Knows nothing of what the lines mean.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "emulator/capture/disk_file.h"

namespace echoloop {

struct BackgroundFileLimits {
    std::uint64_t keep_free = 256ULL << 20;  ///< bytes of the disk that are left to others
    std::size_t most_waiting = 64ULL << 20;  ///< bytes that wait for the disk; lines beyond are lost
};

struct BackgroundFileSummary {
    std::uint64_t lines = 0, bytes = 0;
    std::uint64_t lost = 0;  ///< lines, to a slow disk
    bool stopped = false;    ///< the disk was full or failed
};

class BackgroundFile {
  public:
    /// Appends one line, without its end, to the text.
    using Write = std::function<void(std::string&)>;

    /// Overwrites `file`. `what` names its content in messages ("the ground truth"). Throws StartError if it
    /// cannot be made.
    BackgroundFile(std::filesystem::path file, std::string what, BackgroundFileLimits limits = {});
    ~BackgroundFile();
    BackgroundFile(const BackgroundFile&) = delete;
    BackgroundFile& operator=(const BackgroundFile&) = delete;

    /// From any thread. `write` is called on the file's own thread; what it holds until then is about
    /// `bytes`.
    void add(std::size_t bytes, Write write);
    void add(std::string line);
    /// Writes what still waits; nothing is added after it.
    void finish();

    BackgroundFileSummary summary() const;
    const std::filesystem::path& file() const { return path_; }

  private:
    struct Line {
        std::size_t bytes;
        Write write;
    };

    void keep_writing(std::stop_token stop);
    void write(std::deque<Line>& lines);
    void write(const std::string& text, std::uint64_t lines);
    void give_up(const std::string& reason);

    std::string what_;
    BackgroundFileLimits limits_;
    std::filesystem::path path_;

    mutable std::mutex mutex_;  // of all that follows up to summary_
    std::condition_variable_any more_;
    std::deque<Line> waiting_;
    std::size_t waiting_bytes_ = 0;
    BackgroundFileSummary summary_;

    DiskFile file_;        // of the writing thread
    std::jthread thread_;  // last: ends first
};

}  // namespace echoloop
