#include "tools/view/feed.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace echoloop::view {
namespace {

constexpr std::chrono::milliseconds between_large(100);
constexpr std::chrono::seconds between_unseen(1);  // that nobody has on the screen
constexpr std::chrono::seconds between_late(1);    // of a sonar whose pings are late: looking costs time, too
// Objects cost much: a ping with them takes up to 1.6 times as long.
constexpr std::chrono::seconds between_objects(1), between_late_objects(5);
constexpr std::chrono::milliseconds between_small_objects(200);
constexpr Time late_after = std::chrono::milliseconds(1);
constexpr std::size_t large = 8192;           // values; smaller ones are lines of a picture, and all are kept
constexpr std::size_t most_lines = 64;        // of a sonar, between two calls of take()
constexpr std::size_t most_passed = 1000;     // between two calls of take()
constexpr std::size_t most_bytes = 4U << 20;  // the same
constexpr std::size_t long_message = 12U << 10;       // by TCP: images and soundings
constexpr std::chrono::milliseconds of_one_ping(50);  // come its messages: both sides of a side-scan
constexpr std::size_t longest_kept = 4U << 20;        // of one message
constexpr std::size_t most_before = 256U << 10;

double unix_now() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::pair<std::string, long> key_of(std::string_view device, const Shot& shot) {
    return {std::string(device), std::lround(shot.frequency / 1000)};
}

Passed copied(const SeenBytes& seen, std::size_t keep) {
    return {std::string(seen.device),
            std::string(seen.port),
            seen.sent,
            seen.packets,
            seen.unix_time > 0 ? seen.unix_time : unix_now(),
            Bytes(seen.bytes.begin(), seen.bytes.begin() + static_cast<std::ptrdiff_t>(keep)),
            seen.bytes.size()};
}

}  // namespace

void Feed::look(std::size_t viewers, Looks looks) {
    const std::scoped_lock lock(mutex_);
    looks_ = std::move(looks);
    if (viewers > 0 && viewers_ == 0) {
        passed_.assign(std::make_move_iterator(before_.begin()), std::make_move_iterator(before_.end()));
        before_.clear();
        before_bytes_ = 0;
        lines_.clear();
    }
    viewers_ = viewers;
}

Wanted Feed::wants_ping(std::string_view device, const Shot& shot) {
    if (viewers_ == 0) return Wanted::nothing;
    const bool is_large = shot.beams() * shot.bins >= large;
    const std::scoped_lock lock(mutex_);
    Sonar& sonar = sonars_[key_of(device, shot)];
    const Moment now = now_();
    if (is_large) {
        const auto between = sonar.late                   ? Moment::duration(between_late)
                             : looks_.shows_heard(device) ? between_large
                                                          : between_unseen;
        if (now - sonar.wanted < between) return Wanted::nothing;
        sonar.wanted = now;
    }
    const auto between = is_sparing()                 ? Moment::duration(between_late_objects)
                         : is_large                   ? between_objects
                         : looks_.shows_truth(device) ? Moment::duration::zero()
                                                      : between_small_objects;
    if (now - sonar.wanted_objects < between) return Wanted::levels;
    sonar.wanted_objects = now;
    return Wanted::objects;
}

void Feed::ping(const SeenPing& ping) {
    auto copy = std::make_shared<const Kept>(kept(ping));
    const std::size_t most = ping.echogram.values.size() < large ? most_lines : 1;
    const std::scoped_lock lock(mutex_);
    Sonar& sonar = sonars_[key_of(ping.device, ping.echogram.shot)];
    sonar.late = ping.late > late_after;
    if (sonar.late) last_late_ = now_();
    auto& pings = sonar.pings;
    pings.push_back(std::move(copy));
    if (pings.size() > most) pings.pop_front();
}

void Feed::bytes(const SeenBytes& seen) {
    if (viewers_ == 0 && seen.sent) return;
    const std::scoped_lock lock(mutex_);
    if (viewers_ == 0) return keep_for_later(seen);
    const Line line{std::string(seen.device), std::string(seen.port)};
    LineCount& count = lines_[line];
    (seen.sent ? count.out : count.in) += seen.bytes.size();
    count.rate = seen.line_rate;
    if (is_unwanted(seen)) return;
    const std::size_t keep = std::min(seen.bytes.size(), longest_kept);
    if (passed_.size() >= most_passed || passed_bytes_ + keep > most_bytes) {
        left_out_ += seen.bytes.size();
        gaps_.insert({line, seen.sent});
        return;
    }
    passed_bytes_ += keep;
    passed_.push_back(copied(seen, keep));
    passed_.back().gap = gaps_.erase({line, seen.sent}) > 0;
    const auto found = seen.sent ? long_.find(line) : long_.end();
    if (found != long_.end() && seen.bytes.size() >= long_message)
        passed_.back().unread = std::exchange(found->second.unread, 0);
}

/// Long messages of a sonar, each in one piece, where what it says is on no screen: those of one ping a
/// second are wanted.
bool Feed::is_unwanted(const SeenBytes& seen) {
    if (!seen.sent || seen.packets || seen.bytes.size() < long_message) return false;
    Long& known = long_[{std::string(seen.device), std::string(seen.port)}];
    const Moment now = now_();
    if (now - known.read < of_one_ping) return false;
    const bool wanted =
        (looks_.shows_said(seen.device) && !is_sparing()) || now - known.read >= between_unseen;
    if (wanted)
        known.read = now;
    else
        ++known.unread;
    return !wanted;
}

/// The oldest goes first: of a driver that says much, what it set long ago.
void Feed::keep_for_later(const SeenBytes& seen) {
    if (seen.bytes.size() > most_before) return;
    before_bytes_ += seen.bytes.size();
    before_.push_back(copied(seen, seen.bytes.size()));
    while (before_bytes_ > most_before || before_.size() > most_passed) {
        before_bytes_ -= before_.front().bytes.size();
        before_.pop_front();
    }
}

std::map<Feed::Line, LineCount> Feed::lines() const {
    const std::scoped_lock lock(mutex_);
    return lines_;
}

void Feed::fault(const SeenFault& seen) {
    if (viewers_ == 0) return;
    const std::scoped_lock lock(mutex_);
    if (faults_.size() < most_passed)
        faults_.push_back({std::string(seen.device), std::string(seen.port), seen.unix_time, seen.text,
                           seen.on_message, seen.sent});
}

Feed::News Feed::take() {
    News news;
    const std::scoped_lock lock(mutex_);
    news.sparing = is_sparing();
    for (auto& [key, sonar] : sonars_) {
        news.pings.insert(news.pings.end(), sonar.pings.begin(), sonar.pings.end());
        sonar.pings.clear();
    }
    std::ranges::stable_sort(news.pings, {}, [](const auto& ping) { return ping->transmitted; });
    news.passed = std::exchange(passed_, {});
    news.faults = std::exchange(faults_, {});
    news.bytes_left_out = std::exchange(left_out_, 0);
    passed_bytes_ = 0;
    return news;
}

}  // namespace echoloop::view
