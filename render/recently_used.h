// Things that are dear to make and serve many pings, so that several devices can share a renderer. Keeps
// those that were used last and never more than it may.
#pragma once

#include <cstddef>
#include <list>
#include <utility>

namespace echoloop {

template <typename Value>
class RecentlyUsed {
  public:
    /// `most`: weight of all values together. The newest is kept whatever its weight.
    explicit RecentlyUsed(std::size_t most) : most_(most) {}

    /// The first value for which fits(value) holds, else what make() returns: a pair of value and weight.
    /// Valid until the next call.
    template <typename Fits, typename Make>
    Value& get(const Fits& fits, const Make& make) {
        for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
            if (fits(std::as_const(entry->first))) {
                entries_.splice(entries_.begin(), entries_, entry);
                return entry->first;
            }
        entries_.push_front(make());
        weight_ += entries_.front().second;
        while (weight_ > most_ && entries_.size() > 1) {
            weight_ -= entries_.back().second;
            entries_.pop_back();
        }
        return entries_.front().first;
    }

  private:
    std::size_t most_, weight_ = 0;
    std::list<std::pair<Value, std::size_t>> entries_;  ///< last used first
};

}  // namespace echoloop
