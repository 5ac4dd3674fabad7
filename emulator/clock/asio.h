// The one door to Boost.Asio: include order and switches that its 1.74 release needs with coroutines, and the
// few names the emulator uses. Include it in runtime code only, never from a device.
#pragma once

#include <exception>
#include <string>
#include <utility>  // before asio/awaitable.hpp, which uses std::exchange without including it

#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>

namespace echoloop {

namespace asio = boost::asio;
using boost::system::error_code;

template <class T>
using Task = asio::awaitable<T>;

/// Completion token: the coroutine resumes and `ec` holds the outcome instead of an exception.
inline auto into(error_code& ec) { return asio::redirect_error(asio::use_awaitable, ec); }

/// Completion handler of co_spawn for coroutines that serve a wire: an exception is a fault of this program;
/// it is logged with `what` and ends that coroutine, not the run.
class Serving {
  public:
    explicit Serving(std::string what) : what_(std::move(what)) {}
    void operator()(std::exception_ptr error) const;

  private:
    std::string what_;
};

}  // namespace echoloop
