// Several who look at one run: each gets the pings that it wants.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "emulator/capture/watch.h"

namespace echoloop {

class Watches final : public Watch {
  public:
    /// Before the run is made. `watch` outlives this.
    void add(Watch& watch) { all_.push_back(&watch); }
    std::size_t size() const { return all_.size(); }

    Wanted wants_ping(std::string_view device, const Shot& shot) override;
    void ping(const SeenPing& ping) override;
    void bytes(const SeenBytes& bytes) override;
    void fault(const SeenFault& fault) override;

  private:
    using ByNumber = std::map<std::uint64_t, std::vector<bool>>;  ///< by number of a ping under way: by whom

    std::vector<Watch*> all_;
    std::mutex mutex_;  // of what follows
    std::map<std::string, ByNumber, std::less<>> wanted_;
};

}  // namespace echoloop
