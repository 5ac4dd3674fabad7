// A folder for links, the loop that the emulator would run, and what a driver does with a terminal.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "emulator/transport/transport.h"

namespace echoloop::test {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// A folder of its own for each test.
class PtyTest : public testing::Test {
  protected:
    PtyTest() {
        std::string name = (fs::temp_directory_path() / "echoloop-pty-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
    }
    ~PtyTest() override { fs::remove_all(folder_); }

    int open_link(const fs::path& link) { return ::open(link.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK); }

    /// Runs the loop until `done` or for two seconds.
    template <class Done>
    bool run_until(Done done) {
        const auto end = std::chrono::steady_clock::now() + 2s;
        while (!done() && std::chrono::steady_clock::now() < end) {
            io_.restart();
            io_.run_for(1ms);
        }
        return done();
    }

    void start(Transport& transport) {
        transport.start(
            {[this](ByteView bytes, Address) { heard_.insert(heard_.end(), bytes.begin(), bytes.end()); },
             [this] { ++reconnected_; }});
    }

    void write(Transport& transport, const Bytes& bytes) {
        bool done = false;
        asio::co_spawn(
            io_, [&]() -> Task<void> { co_await transport.write(bytes, {}); },
            [&done](std::exception_ptr) { done = true; });
        run_until([&] { return done; });
    }

    /// The next `size` bytes that the driver reads; fewer if they do not come within two seconds.
    static Bytes read_exactly(int fd, std::size_t size) {
        Bytes bytes(size);
        std::size_t have = 0;
        pollfd waiting{fd, POLLIN, 0};
        while (have<size&& ::poll(&waiting, 1, 2000)> 0) {
            const ssize_t n = ::read(fd, bytes.data() + have, size - have);
            if (n <= 0) break;
            have += static_cast<std::size_t>(n);
        }
        bytes.resize(have);
        return bytes;
    }

    fs::path folder_;
    asio::io_context io_;
    Bytes heard_;
    int reconnected_ = 0;
};

}  // namespace echoloop::test
