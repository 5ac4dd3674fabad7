#include "tools/view/foxglove_hub.h"

#include <boost/beast/websocket.hpp>
#include <utility>

namespace echoloop::view {

struct FoxgloveHub::Viewer {
    explicit Viewer(boost::beast::tcp_stream&& stream) : socket(std::move(stream)) {}
    boost::beast::websocket::stream<boost::beast::tcp_stream> socket;
    std::shared_ptr<FoxgloveClient> client{};
    bool writing = false, closed = false;
};

bool FoxgloveHub::is_meant(const Request& request, const std::string& token) {
    const auto offered = request[boost::beast::http::field::sec_websocket_protocol];
    return boost::beast::websocket::is_upgrade(request) && request.target() == "/?token=" + token &&
           !foxglove_protocol({offered.data(), offered.size()}).empty();
}

void FoxgloveHub::tell(const Feed::News& news) {
    if (viewers_.empty()) return;
    for (const auto& ping : news.pings) foxglove_.ping(*ping);
    for (const Passed& one : news.passed)
        foxglove_.bytes({.device = one.device,
                         .port = one.port,
                         .sent = one.sent,
                         .packets = one.packets,
                         .unix_time = one.unix_time,
                         .bytes = one.bytes,
                         .left_out = one.size - one.bytes.size(),
                         .gap = one.gap});
    for (const bag::Fault& one : news.faults) foxglove_.fault(one);
    for (const auto& viewer : viewers_) send(viewer);
}

Task<void> FoxgloveHub::show(boost::beast::tcp_stream stream, Request request,
                             std::function<void()> changed) {
    namespace websocket = boost::beast::websocket;
    constexpr std::size_t longest_line = 64 << 10;  // bytes; one may subscribe to all at once
    const auto viewer = std::make_shared<Viewer>(std::move(stream));
    auto& socket = viewer->socket;
    const auto offered = request[boost::beast::http::field::sec_websocket_protocol];
    socket.set_option(websocket::stream_base::timeout::suggested(boost::beast::role_type::server));
    socket.set_option(websocket::stream_base::decorator(
        [protocol = foxglove_protocol({offered.data(), offered.size()})](websocket::response_type& answer) {
            answer.set(boost::beast::http::field::server, "echoloop");
            answer.set(boost::beast::http::field::sec_websocket_protocol, protocol);
        }));
    socket.read_message_max(longest_line);
    error_code ec;
    co_await socket.async_accept(request, into(ec));
    if (ec) co_return;
    viewer->client = foxglove_.join();
    viewers_.push_back(viewer);
    changed();
    send(viewer);
    boost::beast::flat_buffer buffer;
    while (!ec) {
        buffer.clear();
        co_await socket.async_read(buffer, into(ec));
        if (!ec && socket.got_text())
            Foxglove::hear(*viewer->client, boost::beast::buffers_to_string(buffer.data()));
    }
    viewer->closed = true;
    foxglove_.leave(viewer->client);
    viewers_.remove(viewer);
    changed();
}

void FoxgloveHub::send(const std::shared_ptr<Viewer>& viewer) {
    if (viewer->client->waits() && !std::exchange(viewer->writing, true))
        asio::co_spawn(io_, write(viewer), Serving("view"));
}

Task<void> FoxgloveHub::write(std::shared_ptr<Viewer> viewer) {
    error_code ec;
    while (!viewer->closed && !ec) {
        const auto frame = viewer->client->next();
        if (!frame) break;
        viewer->socket.binary(frame->binary);
        co_await viewer->socket.async_write(asio::buffer(*frame->bytes), into(ec));
    }
    viewer->writing = false;
}

}  // namespace echoloop::view
