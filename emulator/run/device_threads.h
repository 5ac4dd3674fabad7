// Threads on which devices make bytes of large echograms, so that the wires of others do not wait.
#pragma once

#include <functional>
#include <thread>
#include <vector>

#include "emulator/clock/asio.h"
#include "emulator/machine/scheduling.h"

namespace echoloop {

class DeviceThreads {
  public:
    DeviceThreads() {
        constexpr std::size_t threads = 2;
        for (std::size_t i = 0; i < threads; ++i)
            threads_.emplace_back([this] {
                wake_on_time();
                mailbox_.run();
            });
    }
    ~DeviceThreads() { join(); }
    DeviceThreads(const DeviceThreads&) = delete;
    DeviceThreads& operator=(const DeviceThreads&) = delete;

    /// One of them does `work`, which must not throw, when one is free; in the order of these calls.
    void post(std::function<void()> work) { asio::post(mailbox_, std::move(work)); }
    /// Returns when all is done and they have ended. Nothing must be posted afterwards.
    void join() {
        open_.reset();
        threads_.clear();
    }

  private:
    asio::io_context mailbox_;
    asio::executor_work_guard<asio::io_context::executor_type> open_ = asio::make_work_guard(mailbox_);
    std::vector<std::jthread> threads_;
};

}  // namespace echoloop
