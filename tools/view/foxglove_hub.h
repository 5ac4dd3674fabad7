// Viewers that speak Foxglove's protocol, each on a WebSocket. Beast's, on one thread.
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <functional>
#include <list>
#include <memory>
#include <string>

#include "emulator/clock/asio.h"
#include "tools/view/feed.h"
#include "tools/view/foxglove.h"

namespace echoloop::view {

class FoxgloveHub {
  public:
    using Request = boost::beast::http::request<boost::beast::http::empty_body>;

    FoxgloveHub(asio::io_context& io, bag::About about) : io_(io), foxglove_(std::move(about)) {}

    /// A WebSocket that offers one of the protocols, at "/?token=TOKEN". Any page may ask that knows the
    /// token: Foxglove's programs and Lichtblick have origins of their own.
    static bool is_meant(const Request& request, const std::string& token);
    std::size_t viewers() const { return viewers_.size(); }
    void tell(const Feed::News& news);
    /// Until the viewer leaves. `changed` is called when one comes or goes.
    Task<void> show(boost::beast::tcp_stream stream, Request request, std::function<void()> changed);

  private:
    struct Viewer;
    void send(const std::shared_ptr<Viewer>& viewer);
    Task<void> write(std::shared_ptr<Viewer> viewer);

    asio::io_context& io_;
    Foxglove foxglove_;
    std::list<std::shared_ptr<Viewer>> viewers_;
};

}  // namespace echoloop::view
