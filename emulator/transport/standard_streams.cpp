#include "emulator/transport/standard_streams.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "emulator/contract/error.h"

namespace echoloop {
namespace {

/// Opened anew: waiting makes a description non-blocking, and the shell's must stay as it is. A socket cannot
/// be opened.
int own_standard_input() {
    const int own = ::open("/proc/self/fd/0", O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    return own >= 0 ? own : ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0);
}

bool is_plain_file(int fd) {
    struct stat status {};
    return ::fstat(fd, &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

StandardStreams::StandardStreams(asio::io_context& io) : input_(io) {
    const int own = own_standard_input();
    if (own < 0)
        throw StartError(Exit::unavailable,
                         std::string("stdin: there is no standard input: ") + std::strerror(errno));
    error_code ec;
    if (is_plain_file(own))
        file_ = own;
    else
        input_.assign(own, ec);
    if (!ec) return;
    ::close(own);
    throw StartError(Exit::unavailable, "stdin: it cannot be waited for (" + ec.message() +
                                            "); give it a pipe, a file or a terminal");
}

void StandardStreams::start(Events events) {
    events_ = std::move(events);
    asio::co_spawn(input_.get_executor(), read(), Serving(describe()));
}

Task<void> StandardStreams::read() {
    error_code ec;
    while (const std::size_t size = co_await some(ec)) {
        count_in(size);
        events_.received(ByteView(buffer_).first(size), {});
    }
    if (ec != asio::error::operation_aborted) events_.disconnected({});
}

Task<std::size_t> StandardStreams::some(error_code& ec) {
    if (file_ < 0) co_return co_await input_.async_read_some(asio::buffer(buffer_), into(ec));
    co_await asio::post(input_.get_executor(), asio::use_awaitable);  // others have their turn
    const ssize_t size = file_ < 0 ? 0 : ::read(file_, buffer_.data(), buffer_.size());
    if (file_ < 0) ec = asio::error::operation_aborted;
    co_return static_cast<std::size_t>(std::max<ssize_t>(0, size));
}

Task<void> StandardStreams::write(ByteView bytes, Address) {
    const std::size_t written = std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    std::fflush(stdout);
    count_out(written);
    count_lost(bytes.size() - written);
    co_return;
}

void StandardStreams::close() {
    error_code ignored;
    input_.close(ignored);
    if (const int file = std::exchange(file_, -1); file >= 0) ::close(file);
}

}  // namespace echoloop
