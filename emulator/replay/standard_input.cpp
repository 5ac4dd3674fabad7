#include "emulator/replay/standard_input.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

namespace echoloop::replay {

StandardInput::StandardInput(asio::io_context& io, std::function<void()> line)
    : input_(io), line_(std::move(line)) {}

void StandardInput::start() {
    // Opened anew: waiting makes a description non-blocking, and the shell's must stay as it is.
    const int own = ::open("/proc/self/fd/0", O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    error_code ec;
    if (own >= 0) input_.assign(own, ec);
    if (ec && own >= 0) ::close(own);
    if (input_.is_open()) read();
}

void StandardInput::read() {
    input_.async_read_some(asio::buffer(buffer_), [this](error_code ec, std::size_t size) {
        if (ec) return;
        const auto lines =
            std::count(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(size), '\n');
        for (std::ptrdiff_t i = 0; i < lines; ++i) line_();
        read();
    });
}

}  // namespace echoloop::replay
