#include "tools/view/server.h"

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <exception>
#include <list>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "emulator/clock/asio.h"
#include "emulator/contract/error.h"
#include "emulator/machine/scheduling.h"
#include "emulator/run/token.h"
#include "emulator/transport/address.h"
#include "tools/view/collector.h"
#include "tools/view/foxglove_hub.h"
#include "tools/view/gate.h"

namespace echoloop::view {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_viewers = 32, longest_header = 8192, longest_line = 4096;
constexpr std::chrono::seconds patience(10);  // for a request
constexpr std::chrono::milliseconds breath_after_fault(100);
constexpr int times_between_status = 5;

struct News {
    bool binary = false;
    std::string bytes;
};
using Batch = std::vector<std::shared_ptr<const News>>;

std::shared_ptr<const News> text_news(std::string text) {
    return std::make_shared<const News>(News{false, std::move(text)});
}

/// {"type": "lines", "t": s, "lines": [{"device", "port", "in", "out": bytes so
/// far, "rate": bit/s}]}
std::string lines_message(const std::map<Feed::Line, LineCount>& lines) {
    const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
    Json all{{"type", "lines"}, {"t", now.count()}, {"lines", Json::array()}};
    for (const auto& [line, count] : lines)
        all["lines"].push_back({{"device", line.first},
                                {"port", line.second},
                                {"in", count.in},
                                {"out", count.out},
                                {"rate", count.rate}});
    return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

class Server::Impl {
  public:
    Impl(Feed& feed, ServerOptions options)
        : options_(std::move(options)),
          acceptor_(io_),
          ticker_(options_.families),
          foxglove_(io_, options_.about),
          collector_(feed, [this](Feed::News news, std::map<Feed::Line, LineCount> lines) {
              asio::post(io_, [this, news = std::move(news), lines = std::move(lines)] {
                  try {
                      tell_news(news, lines);
                      collector_.deliver_next();
                  } catch (...) {
                      Serving("view")(std::current_exception());
                  }
              });
          }) {
        error_code ec;
        acceptor_.open(Tcp::v4());
        acceptor_.set_option(asio::socket_base::reuse_address(true));
        acceptor_.bind(to_endpoint<Tcp::endpoint>(options_.address), ec);
        if (!ec) acceptor_.listen(asio::socket_base::max_listen_connections, ec);
        if (ec)
            throw StartError(Exit::unavailable, "--view: " + to_text(options_.address) + ": " + ec.message() +
                                                    "; name another port, or 0 for any");
        gate_.emplace(to_address(acceptor_.local_endpoint()),
                      options_.token.empty() ? random_token() : options_.token);
        asio::co_spawn(io_, accept(), Serving("view"));
        thread_ = std::thread([this] {
            // What a driver waits for goes first; but a twentieth of a processor is left to who wants to see
            // why pings are late.
            give_way(15);
            io_.run();
        });
    }

    ~Impl() {
        io_.stop();
        thread_.join();
    }

    std::string link() const { return gate_->link(); }
    std::string foxglove() const { return gate_->foxglove(); }

  private:
    struct Viewer {
        explicit Viewer(beast::tcp_stream&& stream) : socket(std::move(stream)) {}
        websocket::stream<beast::tcp_stream> socket;
        Batch waiting;  ///< what is being sent, or is to be sent next
        bool writing = false;
        bool closed = false;
        std::optional<Looks> looks{};  ///< none: it has not said what it shows
    };

    Task<void> accept() {
        error_code ec;
        while (true) {
            Tcp::socket socket = co_await acceptor_.async_accept(into(ec));
            if (ec) {
                asio::steady_timer breath(io_, breath_after_fault);
                co_await breath.async_wait(into(ec));
            } else if (connections_ < most_viewers) {
                asio::co_spawn(io_, serve(beast::tcp_stream(std::move(socket))), Serving("view"));
            }
        }
    }

    Task<void> serve(beast::tcp_stream stream) {
        const Counted counted(connections_);
        beast::flat_buffer buffer;
        error_code ec;
        while (true) {
            http::request_parser<http::empty_body> parser;
            parser.header_limit(longest_header);
            parser.body_limit(0);
            stream.expires_after(patience);
            co_await http::async_read(stream, buffer, parser, into(ec));
            if (ec) co_return;
            const Request request = parser.release();
            if (websocket::is_upgrade(request) && request.target() == "/news" && gate_->lets_in(request)) {
                stream.expires_never();
                co_return co_await show(std::make_shared<Viewer>(std::move(stream)), request);
            }
            if (gate_->is_for_us(request) && FoxgloveHub::is_meant(request, gate_->token())) {
                stream.expires_never();
                co_return co_await foxglove_.show(std::move(stream), request, [this] { look(); });
            }
            auto answer = gate_->answer_to(request, options_.scene);
            answer.keep_alive(request.keep_alive());
            answer.prepare_payload();
            co_await http::async_write(stream, answer, into(ec));
            if (ec || !answer.keep_alive()) break;
        }
        stream.socket().shutdown(Tcp::socket::shutdown_both, ec);
    }

    Task<void> show(std::shared_ptr<Viewer> viewer, const Request& request) {
        error_code ec;
        auto& socket = viewer->socket;
        socket.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
        socket.set_option(websocket::stream_base::decorator([](websocket::response_type& answer) {
            secure(answer);
            answer.set(http::field::sec_websocket_protocol, std::string(Gate::protocol));
        }));
        socket.read_message_max(longest_line);
        co_await socket.async_accept(request, into(ec));
        if (ec) co_return;
        viewers_.push_back(viewer);
        look();
        offer(viewer, text_news(options_.hello));
        offer(viewer, text_news(ticker_.settings()));
        beast::flat_buffer buffer;
        while (!ec) {
            buffer.clear();
            co_await socket.async_read(buffer, into(ec));
            if (!ec) hear(viewer, beast::buffers_to_string(buffer.data()));
        }
        viewer->closed = true;
        viewers_.remove(viewer);
        look();
    }

    void look() {
        const bool all = foxglove_.viewers() > 0;
        looks_ = {all, all};
        for (const auto& viewer : viewers_) {
            if (!viewer->looks) {
                looks_.all_heard = true;
                continue;
            }
            looks_.heard.insert(viewer->looks->heard.begin(), viewer->looks->heard.end());
            looks_.said.insert(viewer->looks->said.begin(), viewer->looks->said.end());
            looks_.truth.insert(viewer->looks->truth.begin(), viewer->looks->truth.end());
        }
        collector_.look(viewers_.size() + foxglove_.viewers(), looks_);
    }

    /// {"looks": {"heard": ["sonar", ...], "said": [...], "true": [...]}}: the
    /// devices whose layers it shows.
    void note_looks(Viewer& viewer, const Json& told) {
        Looks looks{false};
        const std::pair<const char*, std::set<std::string, std::less<>>*> layers[] = {
            {"heard", &looks.heard}, {"said", &looks.said}, {"true", &looks.truth}};
        for (const auto& [name, devices] : layers) {
            if (!told.contains(name) || !told[name].is_array()) continue;
            for (const Json& device : told[name])
                if (device.is_string()) devices->insert(device.get<std::string>());
        }
        viewer.looks = std::move(looks);
        look();
    }

    /// {"ask": {"fault": ...}, "id": 3}: what a client of the control place says,
    /// and a number for the answer.
    void hear(const std::shared_ptr<Viewer>& viewer, const std::string& text) {
        const Json said = Json::parse(text, nullptr, false);
        if (said.is_object() && said.contains("looks") && said["looks"].is_object())
            return note_looks(*viewer, said["looks"]);
        if (!said.is_object() || !said.contains("ask") || !said["ask"].is_object()) return;
        const Json id = said.value("id", Json(nullptr));
        if (!options_.control) {
            const Json refused{{"type", "answer"},
                               {"id", id},
                               {"answer",
                                {{"ok", false},
                                 {"error",
                                  "this page only shows; start the run with --view-control "
                                  "to let it ask for faults"}}}};
            return offer(viewer, text_news(refused.dump()));
        }
        options_.ask(said["ask"].dump(), [this, id, who = std::weak_ptr(viewer)](const std::string& answer) {
            asio::post(io_, [this, id, who, answer] {
                const auto there = who.lock();
                if (!there) return;
                const Json told{
                    {"type", "answer"}, {"id", id}, {"answer", Json::parse(answer, nullptr, false)}};
                offer(there, text_news(told.dump()));
            });
        });
    }

    void tell_news(const Feed::News& news, const std::map<Feed::Line, LineCount>& lines) {
        foxglove_.tell(news);
        if (viewers_.empty()) return;
        for (const auto& ping : news.pings)
            tell(std::make_shared<const News>(News{true, view::message_of(*ping)}));
        Ticker::Told told =
            ticker_.take(news.passed, news.faults, news.bytes_left_out, news.sparing,
                         [this](const std::string& device) { return looks_.shows_said(device); });
        for (std::string& picture : told.pictures)
            tell(std::make_shared<const News>(News{true, std::move(picture)}));
        if (!told.messages.empty()) tell(text_news(std::move(told.messages)));
        if (times_told_++ % times_between_status != 0) return;
        ask_status();
        tell(text_news(lines_message(lines)));
    }

    void ask_status() {
        options_.ask(R"({"status": true})", [this](const std::string& answer) {
            asio::post(
                io_, [this, answer] { tell(text_news(R"({"type": "status", "status": )" + answer + "}")); });
        });
    }

    void tell(const std::shared_ptr<const News>& news) {
        for (const auto& viewer : viewers_) offer(viewer, news);
    }

    /// Dropped where the viewer has not even read what it was sent before.
    void offer(const std::shared_ptr<Viewer>& viewer, const std::shared_ptr<const News>& news) {
        constexpr std::size_t most_waiting = 256;
        if (viewer->closed || viewer->waiting.size() >= most_waiting) return;
        viewer->waiting.push_back(news);
        if (!std::exchange(viewer->writing, true)) asio::co_spawn(io_, write(viewer), Serving("view"));
    }

    Task<void> write(std::shared_ptr<Viewer> viewer) {
        error_code ec;
        while (!viewer->waiting.empty() && !viewer->closed && !ec)
            for (const auto& news : std::exchange(viewer->waiting, {})) {
                viewer->socket.binary(news->binary);
                co_await viewer->socket.async_write(asio::buffer(news->bytes), into(ec));
                if (ec || viewer->closed) break;
            }
        viewer->writing = false;
    }

    /// A connection that is open.
    struct Counted {
        explicit Counted(std::size_t& all) : count(all) { ++count; }
        ~Counted() { --count; }
        Counted(const Counted&) = delete;
        Counted& operator=(const Counted&) = delete;
        std::size_t& count;
    };

    ServerOptions options_;
    Looks looks_{};  ///< of all viewers
    std::size_t connections_ = 0;
    asio::io_context io_;  // its coroutines, which it ends last, refer to what is above
    std::list<std::shared_ptr<Viewer>> viewers_;
    Tcp::acceptor acceptor_;
    std::optional<Gate> gate_;  // once the port is known
    Ticker ticker_;
    FoxgloveHub foxglove_;
    int times_told_ = 0;
    std::thread thread_;
    Collector collector_;
};

Server::Server(Feed& feed, ServerOptions options) : impl_(std::make_unique<Impl>(feed, std::move(options))) {}
Server::~Server() = default;
std::string Server::link() const { return impl_->link(); }
std::string Server::foxglove() const { return impl_->foxglove(); }

}  // namespace echoloop::view
