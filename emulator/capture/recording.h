// One pcapng file of everything that the ports of a run hear and say. A thread of its own writes it, so that
// a slow disk delays nobody; a full one ends the recording and never the emulation.
#pragma once

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "emulator/capture/disk_file.h"
#include "emulator/capture/pcapng.h"

namespace echoloop {

struct RecordingLimits {
    std::uint64_t file_bytes = 0;              ///< begin another file after so many; 0: one file
    std::uint64_t keep_free = 256ULL << 20;    ///< bytes of the disk that are left to others
    std::uint64_t most_waiting = 64ULL << 20;  ///< bytes that wait for the disk; packets beyond are lost
};

struct RecordingSummary {
    std::uint64_t packets = 0, bytes = 0;
    std::uint64_t lost = 0;  ///< packets, to a slow disk
    std::size_t files = 1;
    bool stopped = false;  ///< the disk was full or failed
};

class Recording {
  public:
    /// Overwrites `file`; further ones are called `file`-2.pcapng and so on. Throws StartError if it cannot
    /// be made.
    explicit Recording(std::filesystem::path file, RecordingLimits limits = {});
    /// Of nothing, and at no cost, until begin() names a file.
    explicit Recording(RecordingLimits limits);
    ~Recording();
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    /// Records from now on into `file`; what was recorded before is finished. On one thread with finish().
    /// Throws StartError if the file cannot be made.
    void begin(std::filesystem::path file);
    /// Before the first packet. Returns the number for Packet::interface.
    std::uint32_t add_interface(pcapng::LinkType type, const std::string& name,
                                const std::string& description);
    /// From any thread.
    void add(const pcapng::Packet& packet, ByteView bytes);
    /// Writes what still waits; nothing is added after it, unless begin() follows.
    void finish();
    /// Never goes backwards, whatever happens to the system's clock during a run.
    pcapng::WallTime now() const;
    /// From now on now() asks `time`: of a run whose time is not that of the world.
    void follow(std::function<pcapng::WallTime()> time) { time_ = std::move(time); }

    RecordingSummary summary() const;
    bool is_idle() const { return idle_; }  ///< before begin(), or after finish()
    const std::filesystem::path& file() const { return file_; }

  private:
    void start_writing();
    void open_file();
    void keep_writing(std::stop_token stop);
    void write(const Bytes& blocks);
    void give_up(const std::string& reason);

    std::filesystem::path file_;
    RecordingLimits limits_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    pcapng::WallTime start_time_;
    std::function<pcapng::WallTime()> time_;  ///< empty: the system's

    std::atomic<bool> idle_{false};
    mutable std::mutex mutex_;  // of all that follows up to summary_
    std::condition_variable_any more_;
    Bytes prologue_, waiting_;  ///< blocks that every file begins with; blocks for the disk
    std::uint32_t interfaces_ = 0;
    RecordingSummary summary_;

    std::optional<DiskFile> disk_;  // of the writing thread
    std::jthread thread_;           // last: ends first
};

}  // namespace echoloop
