// What a run shows to those who look: the last pings of each sonar and the messages on its wires. It keeps
// little, and nothing while nobody looks. Knows no sockets.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "emulator/capture/watch.h"
#include "tools/view/picture.h"

namespace echoloop::view {

/// Bytes of one direction of a port, as they passed.
struct Passed {
    std::string device, port;
    bool sent = false, packets = false;
    double unix_time = 0;  ///< s since 1970
    Bytes bytes;           ///< the first of them, where there are very many
    std::size_t size = 0;
};

class Feed final : public Watch {
  public:
    /// While nobody looks, nothing is kept.
    void look(std::size_t viewers) { viewers_ = viewers; }

    bool wants_ping(std::string_view device, const Shot& shot) override;
    void ping(const SeenPing& ping) override;
    void bytes(const SeenBytes& bytes) override;

    /// What has come since the last call, oldest first; of large pictures the latest of each sonar.
    struct News {
        std::vector<std::shared_ptr<const Kept>> pings;
        std::vector<Passed> passed;
        std::size_t bytes_left_out = 0;  ///< there was too much to keep
    };
    News take();

  private:
    struct Sonar {
        std::chrono::steady_clock::time_point wanted{};  ///< when a large ping was asked for last
        std::deque<std::shared_ptr<const Kept>> pings{};
    };

    std::atomic<std::size_t> viewers_{0};
    std::mutex mutex_;  // of all below
    std::map<std::string, Sonar, std::less<>> sonars_;
    std::vector<Passed> passed_;
    std::size_t passed_bytes_ = 0, left_out_ = 0;
};

}  // namespace echoloop::view
