// The bag of a run: everything that happens in it, as messages in one file (MCAP, docs/bags.md). A thread of
// its own makes and writes them; a slow disk costs messages, never the emulation.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "emulator/capture/disk_file.h"
#include "emulator/capture/watch.h"
#include "tools/bag/topics.h"

namespace echoloop::bag {

/// Messages on topics in one file.
class BagFile {
  public:
    /// `keep_free`: bytes of the disk that are left to others. Throws StartError, also where `file` holds
    /// something else than a bag.
    explicit BagFile(std::filesystem::path file, std::uint64_t keep_free = 256ULL << 20);
    ~BagFile();

    /// Each throws std::runtime_error where the disk takes no more.
    void put(const Topics::Offer& offer, const Topics::Make& make);
    /// A file that goes along; nothing where it cannot be read.
    void attach(const std::filesystem::path& file, const std::string& media_type);
    void note(const std::map<std::string, std::string>& entries);
    void flush();
    void finish();

    std::uint64_t messages() const;
    std::uint64_t size() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

struct BagSummary {
    std::uint64_t messages = 0, bytes = 0;
    std::uint64_t lost = 0;  ///< pings and pieces of the wires, to a slow machine or disk
    bool stopped = false;    ///< the disk was full or failed
};

/// What a run tells before its first ping.
struct BagStart {
    About about{};
    std::filesystem::path scene{}, scenario{};
    std::map<std::string, std::string> notes{};
    bool waits = false;  ///< the run's time waits for the writing; else what there is no time for is left out
};

class Bag final : public Watch {
  public:
    /// Throws StartError.
    explicit Bag(const std::filesystem::path& file) : path_(file), file_(file) {}
    ~Bag() override;

    /// What happens before waits for it.
    void begin(BagStart start);
    Wanted wants_ping(std::string_view, const Shot&) override { return Wanted::objects; }
    void ping(const SeenPing& ping) override;
    void bytes(const SeenBytes& bytes) override;
    void fault(const SeenFault& fault) override;
    /// Writes what still waits and ends the file. Throws StartError where it is not whole.
    void finish();

    BagSummary summary() const;
    const std::filesystem::path& file() const { return path_; }

  private:
    using Work = std::function<void(Topics&)>;
    struct Waiting {
        std::size_t bytes;
        Work work;
    };
    enum class Room { shared, kept_back };
    /// False: there was no room, and it is counted as lost.
    bool add(std::size_t bytes, Work work, Room room = Room::shared);
    void keep_writing(std::stop_token stop, const BagStart& start);
    void fail(const std::string& why);

    std::filesystem::path path_;
    BagFile file_;              // of the writing thread
    mutable std::mutex mutex_;  // of all that follows up to fault_
    std::condition_variable_any more_, room_;
    std::deque<Waiting> waiting_;
    std::size_t waiting_bytes_ = 0;
    bool waits_ = false, begun_ = false;
    BagSummary summary_;
    std::string fault_;
    std::jthread thread_;  // last: ends first
};

}  // namespace echoloop::bag
