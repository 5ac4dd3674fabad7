#include "tools/view/feed.h"

#include <utility>

namespace echoloop::view {
namespace {

constexpr std::chrono::milliseconds between_large(100);
constexpr std::size_t large = 8192;           // values; smaller ones are lines of a picture, and all are kept
constexpr std::size_t most_lines = 64;        // of a sonar, between two calls of take()
constexpr std::size_t most_passed = 1000;     // between two calls of take()
constexpr std::size_t most_bytes = 2U << 20;  // the same
constexpr std::size_t longest_kept = 256U << 10;  // of one message

double unix_now() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

bool Feed::wants_ping(std::string_view device, const Shot& shot) {
    if (viewers_ == 0) return false;
    if (shot.beams() * shot.bins < large) return true;
    const std::scoped_lock lock(mutex_);
    auto& wanted = sonars_[std::string(device)].wanted;
    const auto now = std::chrono::steady_clock::now();
    if (now - wanted < between_large) return false;
    wanted = now;
    return true;
}

void Feed::ping(const SeenPing& ping) {
    auto copy = std::make_shared<const Kept>(kept(ping));
    const std::size_t most = ping.echogram.values.size() < large ? most_lines : 1;
    const std::scoped_lock lock(mutex_);
    auto& pings = sonars_[std::string(ping.device)].pings;
    pings.push_back(std::move(copy));
    if (pings.size() > most) pings.pop_front();
}

void Feed::bytes(const SeenBytes& seen) {
    if (viewers_ == 0) return;
    const std::scoped_lock lock(mutex_);
    const std::size_t keep = std::min(seen.bytes.size(), longest_kept);
    if (passed_.size() >= most_passed || passed_bytes_ + keep > most_bytes) {
        left_out_ += seen.bytes.size();
        return;
    }
    passed_bytes_ += keep;
    passed_.push_back({std::string(seen.device), std::string(seen.port), seen.sent, seen.packets, unix_now(),
                       Bytes(seen.bytes.begin(), seen.bytes.begin() + static_cast<std::ptrdiff_t>(keep)),
                       seen.bytes.size()});
}

Feed::News Feed::take() {
    News news;
    const std::scoped_lock lock(mutex_);
    for (auto& [name, sonar] : sonars_) {
        news.pings.insert(news.pings.end(), sonar.pings.begin(), sonar.pings.end());
        sonar.pings.clear();
    }
    news.passed = std::exchange(passed_, {});
    news.bytes_left_out = std::exchange(left_out_, 0);
    passed_bytes_ = 0;
    return news;
}

}  // namespace echoloop::view
