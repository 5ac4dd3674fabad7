// Takes what has come in from the feed, ten times a second, for a thread that may be kept waiting for long.
// Who renders and who answers drivers take the feed's lock, too: so none but ordinary threads may hold it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "tools/view/feed.h"

namespace echoloop::view {

class Collector {
  public:
    /// What has come, and what each line has carried. On the collector's own thread.
    using Deliver = std::function<void(Feed::News, std::map<Feed::Line, LineCount>)>;

    /// `feed` outlives this. `between` deliveries lies at least so much.
    Collector(Feed& feed, Deliver deliver,
              std::chrono::milliseconds between = std::chrono::milliseconds(100));
    ~Collector();
    Collector(const Collector&) = delete;
    Collector& operator=(const Collector&) = delete;

    /// As Feed::look(), at once, and without its lock. On any thread.
    void look(std::size_t viewers, Looks looks);

    /// What was delivered last has been dealt with: until then nothing more comes, and the feed keeps the
    /// latest. On any thread.
    void deliver_next();

  private:
    struct Looking {
        std::size_t viewers = 0;
        Looks looks{};
    };

    void collect(const std::stop_token& stop);

    Feed& feed_;
    Deliver deliver_;
    std::chrono::milliseconds between_;
    std::mutex mutex_;  // of all below
    std::condition_variable_any changed_;
    std::optional<Looking> asked_;  ///< not yet told to the feed
    bool dealt_with_ = true;        ///< what was delivered
    std::jthread thread_;
};

}  // namespace echoloop::view
