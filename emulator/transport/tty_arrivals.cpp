#include "emulator/transport/tty_arrivals.h"

#include <sys/epoll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "emulator/contract/error.h"

namespace echoloop {

void TtyArrivals::watch(int terminal) {
    const int set = ::epoll_create1(EPOLL_CLOEXEC);
    epoll_event change{};
    change.events = EPOLLIN | EPOLLET;
    if (set < 0 || ::epoll_ctl(set, EPOLL_CTL_ADD, terminal, &change) != 0) {
        const std::string reason = std::strerror(errno);
        if (set >= 0) ::close(set);
        throw StartError(Exit::unavailable, "terminal: it cannot be watched: " + reason);
    }
    edges_.assign(set);
}

void TtyArrivals::close() {
    error_code ignored;
    edges_.close(ignored);
}

Task<void> TtyArrivals::wait(error_code& ec) {
    co_await edges_.async_wait(asio::posix::descriptor_base::wait_read, into(ec));
    if (ec) co_return;
    epoll_event noted{};
    ::epoll_wait(edges_.native_handle(), &noted, 1, 0);
}

}  // namespace echoloop
