#include "emulator/listeners.h"

#include <algorithm>
#include <array>
#include <boost/asio/post.hpp>
#include <future>
#include <latch>

#include "emulator/punctual.h"

namespace echoloop {

std::shared_ptr<asio::thread_pool> make_listeners(Punctuality punctuality) {
    constexpr int threads = 2;
    auto pool = std::make_shared<asio::thread_pool>(threads);
    std::array<std::packaged_task<void()>, threads> begin;
    std::array<std::future<void>, threads> begun;
    std::latch all_here(threads);  // so that no thread takes the task of another
    for (auto& task : begin) {
        task = std::packaged_task<void()>([&all_here, punctuality] {
            all_here.arrive_and_wait();
            wake_on_time();
            if (punctuality == Punctuality::real_time) claim_real_time(Turn::listeners);
        });
    }
    std::ranges::transform(begin, begun.begin(), [](auto& task) { return task.get_future(); });
    for (auto& task : begin) asio::post(*pool, [&task] { task(); });
    for (auto& result : begun) result.wait();
    for (auto& result : begun) result.get();
    return pool;
}

}  // namespace echoloop
