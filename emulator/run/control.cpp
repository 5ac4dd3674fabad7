#include "emulator/run/control.h"

#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>

#include "emulator/run/answers.h"
#include "emulator/run/token.h"
#include "emulator/transport/address.h"
#include "emulator/transport/own_folder.h"

namespace echoloop {
namespace {

namespace fs = std::filesystem;
using Local = asio::local::stream_protocol;
using Stream = asio::generic::stream_protocol;
using Socket = Stream::socket;

constexpr std::size_t most_clients = 16;

/// A socket file that nobody serves any more.
bool is_left_over(asio::io_context& io, const fs::path& path) {
    std::error_code ec;
    if (!fs::is_socket(path, ec)) return false;
    Local::socket probe(io);
    probe.open();
    probe.non_blocking(true);  // one that serves nobody may have a full row of waiting clients
    error_code refused;
    probe.connect(Local::endpoint(path.string()), refused);
    return refused == asio::error::connection_refused;
}

StartError cannot_make(const std::string& path, const std::string& reason) {
    return {Exit::cannot_create, "unix:" + path + ": the control socket cannot be made: " + reason};
}

}  // namespace

struct Control::Client {
    Client(Socket&& accepted, bool trust) : socket(std::move(accepted)), trusted(trust) {}
    Socket socket;
    bool trusted;
    std::string waiting;  ///< the beginning of a line
    std::chrono::steady_clock::time_point lively = std::chrono::steady_clock::now();  ///< when it last asked
};

/// The two kinds of place behind one face.
class Control::Listener {
  public:
    Listener(asio::io_context& io, const ControlPlace& place) : local_(io), tcp_(io), path_(place.path) {
        path_.empty() ? listen(place.address) : listen(io);
    }
    ~Listener() { close(); }

    Task<Socket> accept(error_code& ec) {
        if (path_.empty()) co_return co_await tcp_.async_accept(into(ec));
        co_return co_await local_.async_accept(into(ec));
    }
    bool is_open() const { return path_.empty() ? tcp_.is_open() : local_.is_open(); }
    auto executor() { return tcp_.get_executor(); }
    void close() {
        error_code ignored;
        tcp_.close(ignored);
        if (!local_.is_open()) return;
        local_.close(ignored);
        struct stat now {};  // another run may have replaced it meanwhile
        if (::lstat(path_.c_str(), &now) == 0 && now.st_ino == made_.st_ino && now.st_dev == made_.st_dev)
            ::unlink(path_.c_str());
    }
    std::string describe() const {
        error_code ignored;
        return path_.empty() ? "tcp-listen://" + to_text(to_address(tcp_.local_endpoint(ignored)))
                             : "unix:" + path_;
    }

  private:
    void listen(Address address) {
        error_code ec;
        tcp_.open(asio::ip::tcp::v4());
        tcp_.set_option(asio::socket_base::reuse_address(true));
        tcp_.bind(to_endpoint<asio::ip::tcp::endpoint>(address), ec);
        if (!ec) tcp_.listen(most_clients, ec);
        if (ec) throw bind_error("tcp-listen://" + to_text(address), ec);
    }
    /// Nobody can connect before listen(), when the file has its rights already.
    void listen(asio::io_context& io) {
        std::error_code ignored;
        make_own_folder(fs::path(path_).parent_path(), "the control socket",
                        "unix:" + (place_of_ones_own() / "control").string());
        if (is_left_over(io, path_)) fs::remove(path_, ignored);
        error_code ec;
        local_.open();
        local_.bind(Local::endpoint(path_), ec);
        if (ec == asio::error::address_in_use) {
            local_.close();
            throw cannot_make(path_, "it exists already, perhaps of another run; remove it or name another");
        }
        if (ec) {
            local_.close();
            throw cannot_make(path_, ec.message() + "; name a place that you may write to");
        }
        if (::chmod(path_.c_str(), S_IRUSR | S_IWUSR) != 0) throw cannot_make(path_, std::strerror(errno));
        ::lstat(path_.c_str(), &made_);
        local_.listen(most_clients, ec);
        if (ec) throw cannot_make(path_, ec.message());
    }

    Local::acceptor local_;
    asio::ip::tcp::acceptor tcp_;
    std::string path_;
    struct stat made_ {};  ///< the socket file
};

Control::Control(Clock& clock, const ControlPlace& place, ControlDesk& desk)
    : clock_(clock),
      desk_(desk),
      token_(place.path.empty() ? random_token() : ""),
      listener_(std::make_unique<Listener>(clock.io(), place)) {}

Control::~Control() = default;

std::string Control::describe() const { return listener_->describe(); }

void Control::start() { asio::co_spawn(clock_.io(), accept(), Serving(describe())); }

void Control::close() {
    error_code ignored;
    listener_->close();
    for (const auto& client : clients_)
        if (const auto open = client.lock()) open->socket.close(ignored);
}

/// Where all places are taken, for one more: the one who has asked nothing for the longest time, and for a
/// while, leaves.
void Control::make_room() {
    constexpr std::chrono::seconds patience(10);
    std::erase_if(clients_, [](const auto& client) { return client.expired(); });
    if (clients_.size() < most_clients) return;
    const auto last_asked = [](const auto& client) {
        const auto open = client.lock();
        return open ? open->lively : std::chrono::steady_clock::time_point{};
    };
    const auto idle = std::ranges::min_element(clients_, {}, last_asked);
    if (std::chrono::steady_clock::now() - last_asked(*idle) < patience) return;
    error_code ignored;
    if (const auto open = idle->lock()) open->socket.close(ignored);
    clients_.erase(idle);
}

Task<void> Control::accept() {
    error_code ec;
    while (listener_->is_open()) {
        Socket socket = co_await listener_->accept(ec);
        if (!listener_->is_open()) co_return;
        if (!ec) make_room();
        if (ec) {
            asio::steady_timer breath(clock_.io(), std::chrono::milliseconds(100));
            co_await breath.async_wait(into(ec));
        } else if (clients_.size() >= most_clients) {
            spdlog::warn("{}: a client was turned away; {} are connected already", describe(), most_clients);
        } else {
            auto client = std::make_shared<Client>(std::move(socket), token_.empty());
            clients_.push_back(client);
            asio::co_spawn(clock_.io(), serve(client), Serving(describe()));
        }
    }
}

/// One answer after the other: who does not read them cannot ask for more.
Task<void> Control::serve(std::shared_ptr<Client> client) {
    std::array<char, longest_control_line> buffer;
    error_code ec;
    while (!ec) {
        const std::size_t n = co_await client->socket.async_read_some(asio::buffer(buffer), into(ec));
        if (ec) co_return;
        client->waiting.append(buffer.data(), n);
        client->lively = std::chrono::steady_clock::now();
        std::size_t from = 0;
        for (std::size_t end; !ec && (end = client->waiting.find('\n', from)) != std::string::npos;
             from = end + 1) {
            const auto line = std::string_view(client->waiting).substr(from, end - from);
            if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
            const std::string reply = (client->trusted ? desk_.answer(line) : admit(*client, line)) + "\n";
            co_await asio::async_write(client->socket, asio::buffer(reply), into(ec));
            if (!client->trusted) co_return;
        }
        client->waiting.erase(0, from);
        if (client->waiting.size() <= longest_control_line) continue;
        const std::string reply =
            (client->trusted ? desk_.answer(client->waiting) : admit(*client, "")) + "\n";
        co_await asio::async_write(client->socket, asio::buffer(reply), into(ec));
        co_return;
    }
}

/// The first line of a client by TCP.
std::string Control::admit(Client& client, std::string_view line) const {
    client.trusted = tells_token(line, token_);
    if (client.trusted) return answers::welcome();
    return answers::refusal(
        "token: by TCP the first line must be {\"token\": \"...\"} with the token that the run printed at "
        "its "
        "start, or give it to echoloop fault --token; a control place of the kind unix:/PATH needs none");
}

ControlDesk::ControlDesk(Clock& clock, Faults& faults, std::vector<ScenarioDevice> devices,
                         Summaries summaries, Rendering rendering)
    : clock_(clock),
      faults_(faults),
      devices_(std::move(devices)),
      summaries_(std::move(summaries)),
      rendering_(std::move(rendering)) {}

std::string ControlDesk::answer(std::string_view line) {
    using What = ControlRequest::What;
    const Time now = clock_.now();
    const auto [request, reason] = parse_control_line(line, devices_, now);
    if (!request) return answers::refusal(reason);
    switch (request->what) {
        case What::fault:
            if (faults_.count() >= most_faults) break;
            return answers::added(faults_.add(request->fault));
        case What::clear:
            if (!request->id) return answers::cleared(faults_.clear_all());
            if (faults_.clear(*request->id)) return answers::cleared(1);
            return answers::refusal("clear: there is no fault " + std::to_string(*request->id) +
                                    "; {\"list\": true} tells which there are");
        case What::list:
            return answers::list(faults_, now);
        case What::status:
            return answers::status(summaries_(), rendering_(), faults_, now);
    }
    return answers::refusal("there are 1000 faults already; clear some");
}

}  // namespace echoloop
