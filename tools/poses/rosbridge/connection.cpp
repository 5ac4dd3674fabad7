#include "tools/poses/rosbridge/connection.h"

#include <boost/asio/connect.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <regex>
#include <utility>

#include "emulator/clock/asio.h"
#include "emulator/contract/error.h"

namespace echoloop::poses {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using std::chrono::milliseconds, std::chrono::seconds, std::chrono::steady_clock;

constexpr std::size_t largest_message = 4 << 20;  // bytes
constexpr seconds for_an_answer(5), without_a_word(20);

struct Url {
    std::string host, port, path;
};

Url parse(const std::string& url) {
    static const std::regex form(R"(ws://([A-Za-z0-9.-]+)(?::([0-9]{1,5}))?(/[!-~]*)?)");
    std::smatch part;
    if (std::regex_match(url, part, form))
        return {part[1], part[2].matched ? part[2].str() : "9090", part[3].matched ? part[3].str() : "/"};
    const bool secure = url.starts_with("wss:");
    throw StartError(Exit::usage,
                     "--server '" + url + "': " +
                         (secure ? "TLS is not spoken here; forward the port by ssh and write ws://"
                                 : "write it as in ws://127.0.0.1:9090"));
}

}  // namespace

struct Connection::State {
    explicit State(const std::string& text) : url(parse(text)) {}

    /// Runs what is under way until `done`, for that long at most.
    template <class Done>
    void run_until(Done done, steady_clock::time_point end) {
        io.restart();
        while (!done() && steady_clock::now() < end) io.run_one_until(end);
    }

    void start_reading() {
        reading = true;
        socket->async_read(buffer, [this](error_code error, std::size_t) {
            reading = false;
            if (error)
                return close(error == websocket::error::message_too_big
                                 ? "a message of more than 4 MiB was refused"
                                 : error.message());
            if (socket->got_text()) message = beast::buffers_to_string(buffer.data());
            buffer.consume(buffer.size());
        });
    }

    void close(const std::string& reason) {
        why = reason;
        opened = false;
    }

    Url url;
    asio::io_context io;
    std::unique_ptr<websocket::stream<beast::tcp_stream>> socket;
    beast::flat_buffer buffer;
    std::optional<std::string> message;
    std::string why;
    bool opened = false, reading = false;
};

Connection::Connection(const std::string& url) : state_(std::make_unique<State>(url)) {}

Connection::~Connection() {
    if (!state_->opened) return;
    State& s = *state_;
    s.socket->async_close(websocket::close_code::normal, [&s](error_code) { s.opened = false; });
    s.run_until([&s] { return !s.opened; }, steady_clock::now() + seconds(1));
}

bool Connection::is_open() const { return state_->opened; }

const std::string& Connection::why() const { return state_->why; }

bool Connection::open() {
    const Url url = state_->url;
    state_ = std::make_unique<State>("ws://" + url.host + ":" + url.port + url.path);
    State& s = *state_;
    s.socket = std::make_unique<websocket::stream<beast::tcp_stream>>(s.io);
    websocket::stream_base::timeout times =
        websocket::stream_base::timeout::suggested(beast::role_type::client);
    times.handshake_timeout = for_an_answer;
    times.idle_timeout = without_a_word;
    times.keep_alive_pings = true;
    s.socket->set_option(times);
    s.socket->read_message_max(largest_message);
    s.why = "no answer within 5 s";
    asio::co_spawn(
        s.io,
        [&s, url]() -> Task<void> {
            error_code error;
            const auto found =
                co_await asio::ip::tcp::resolver(s.io).async_resolve(url.host, url.port, into(error));
            if (!error) co_await beast::get_lowest_layer(*s.socket).async_connect(found, into(error));
            if (!error)
                beast::get_lowest_layer(*s.socket).socket().set_option(asio::ip::tcp::no_delay(true), error);
            if (!error) co_await s.socket->async_handshake(url.host + ":" + url.port, url.path, into(error));
            s.opened = !error;
            s.why = error.message();
        },
        [](std::exception_ptr) {});
    const auto because = [&s] { return s.opened || s.why != "no answer within 5 s"; };
    s.run_until(because, steady_clock::now() + for_an_answer);
    return s.opened;
}

void Connection::write(const std::string& text) {
    if (!state_->opened) return;
    error_code error;
    state_->socket->text(true);
    state_->socket->write(asio::buffer(text), error);
    if (error) state_->close(error.message());
}

std::optional<std::string> Connection::read(int wait) {
    State& s = *state_;
    if (s.opened && !s.reading) s.start_reading();
    s.run_until([&s] { return s.message || !s.opened; }, steady_clock::now() + milliseconds(wait));
    return std::exchange(s.message, {});
}

}  // namespace echoloop::poses
