// A data set of a run (docs/datasets.md): of each ping its echogram, pictures, labels, truth and bytes, and
// an index. A thread of its own makes and writes them, aside, and gives the folder its name when all is
// there.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "emulator/dataset/aside_folder.h"
#include "emulator/dataset/place.h"
#include "emulator/truth/truth.h"

namespace echoloop {

class Scene;
class DatasetWriter;

struct DatasetLimits {
    std::uint64_t keep_free = 256ULL << 20;  ///< bytes of the disk that are left to others
    std::size_t most_waiting = 256 << 20;    ///< bytes of pings that wait to be written
};

struct DatasetSummary {
    std::uint64_t pings = 0, bytes = 0;
    std::uint64_t lost = 0;  ///< pings, to a slow machine or disk
    bool stopped = false;    ///< a file could not be written
    Time reached{};          ///< run time of the last ping that came
};

/// What a run tells before its first ping.
struct DatasetStart {
    TruthHeader header;       ///< with the sonars, whose places in it are their numbers below
    std::vector<bool> turns;  ///< of each sonar: it is a scanning head
    std::shared_ptr<const Scene> scene;
    bool straight = true;            ///< rays do not bend, so labels can be told those of main lobes
    bool waits = false;              ///< the run's time waits for the writing; else pings are left out
    std::function<void()> failed{};  ///< called once, on another thread, when a file cannot be written
};

class Dataset {
  public:
    /// `folder` is not there yet. Throws StartError.
    explicit Dataset(const std::filesystem::path& folder, DatasetLimits limits = {});
    ~Dataset();
    Dataset(const Dataset&) = delete;
    Dataset& operator=(const Dataset&) = delete;

    void begin(DatasetStart start);
    /// What `failed` calls is gone.
    void forget_run();
    /// From any thread. `ping.echo` has values and objects.
    void heard(std::size_t sonar, PingTruth ping);
    /// For the ping that this sonar has heard last; else nobody's.
    void said(std::size_t sonar, std::size_t port, std::string_view bytes);
    /// Of what waited at the end of the run, how much is written.
    using Told = std::function<void(std::size_t done, std::size_t of)>;
    /// Writes what still waits and gives the folder its name. Throws StartError if it is not whole.
    void finish(const Told& told = {});

    DatasetSummary summary() const;
    const std::filesystem::path& folder() const { return aside_.whole(); }

  private:
    using Work = std::function<void(DatasetWriter&)>;
    struct Waiting {
        std::size_t bytes;
        Work work;
    };
    bool add(std::size_t bytes, bool may_be_left_out, Work work);
    void keep_writing(std::stop_token stop);
    void fail(const std::string& why);
    void tell_rest(const Told& told);

    AsideFolder aside_;
    DatasetLimits limits_;
    DatasetPlace place_;
    std::unique_ptr<DatasetWriter> writer_;
    bool waits_ = false;
    std::vector<std::uint8_t> left_out_;  ///< whether, the last ping of each sonar

    mutable std::mutex mutex_;  // of all that follows up to fault_
    std::condition_variable_any more_, room_;
    std::deque<Waiting> waiting_;
    std::size_t waiting_bytes_ = 0;
    std::function<void()> failed_;
    DatasetSummary summary_;
    std::string fault_;

    std::jthread thread_;  // last: ends first
};

}  // namespace echoloop
