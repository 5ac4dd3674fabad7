// What has come reaches who tells the page of it, once at a time, and while nobody looks nothing does.
#include "tools/view/collector.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <string>
#include <utility>

namespace echoloop::view {
namespace {

struct Delivered {
    Feed::News news;
    std::map<Feed::Line, LineCount> lines;
};

class ACollector : public testing::Test {
  protected:
    /// The next delivery; it counts as not dealt with.
    std::future<Delivered> next() {
        const std::scoped_lock lock(mutex);
        waiting = {};
        return waiting.get_future();
    }

    void said(std::string_view text) {
        const Bytes bytes(text.begin(), text.end());
        feed.bytes({.device = "head", .port = "serial", .sent = true, .bytes = bytes});
    }

    void look_and_wait(std::size_t viewers) {
        collector.look(viewers, {});
        while (feed.viewers() != viewers) std::this_thread::yield();
    }

    std::mutex mutex;
    std::promise<Delivered> waiting;
    Feed feed;
    std::future<Delivered> first = next();
    Collector collector{feed,
                        [this](Feed::News news, std::map<Feed::Line, LineCount> lines) {
                            const std::scoped_lock lock(mutex);
                            waiting.set_value({std::move(news), std::move(lines)});
                        },
                        std::chrono::milliseconds(0)};
};

TEST_F(ACollector, DeliversNothingTwiceAndTheNextWhenTheLastWasDealtWith) {
    look_and_wait(1);
    said("abc");
    std::string all;
    std::size_t carried = 0;
    for (auto coming = std::move(first); carried < 5;) {
        const Delivered delivered = coming.get();
        look_and_wait(2);  // the collector goes round, and a second delivery would break the promise
        look_and_wait(1);
        for (const Passed& passed : delivered.news.passed)
            all.append(passed.bytes.begin(), passed.bytes.end());
        if (delivered.lines.contains({"head", "serial"}))
            carried = delivered.lines.at({"head", "serial"}).out;
        if (all == "abc") said("de");
        coming = next();
        collector.deliver_next();
    }
    EXPECT_EQ(all, "abcde");
}

TEST_F(ACollector, TellsTheFeedThatNobodyLooks) {
    look_and_wait(1);
    first.get();
    look_and_wait(0);
    said("abc");
    EXPECT_TRUE(feed.take().passed.empty());
}

}  // namespace
}  // namespace echoloop::view
