// Who asks a device by HTTP: a reader for each connection, and how long it may take. Writes nothing itself
// but refusals; knows no path.
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "emulator/contract/device.h"
#include "protocols/http/request.h"

namespace echoloop::waterlinked_family {

class HttpHosts {
  public:
    explicit HttpHosts(std::size_t port) : port_(port) {}

    /// Who connects and asks nothing must not keep others out.
    void connected(Address host, Time now) { hosts_[host].deadline = now + patience; }
    void disconnected(Address host) { hosts_.erase(host); }
    std::size_t size() const { return hosts_.size(); }

    /// The requests that are whole by now; what is none is refused in `out`, and counted.
    std::vector<http::Request> received(Address host, ByteView bytes, Time now, Actions& out) {
        Host& one = hosts_[host];
        one.reader.feed(bytes);
        std::vector<http::Request> requests;
        while (const auto next = one.reader.next()) {
            one.deadline = Time::max();
            if (const auto* request = std::get_if<http::Request>(&*next))
                requests.push_back(*request);
            else
                refuse(http::response(std::get<http::Refusal>(*next).status), host, out);
        }
        if (one.reader.pending_bytes() > 0)  // a byte now and then buys no more time
            one.deadline = std::min(one.deadline, now + patience);
        return requests;
    }
    /// Turns away who has taken too long.
    void woken(Time now, Actions& out) {
        for (auto& [host, one] : hosts_) {
            if (now < one.deadline) continue;
            const bool begun = one.reader.pending_bytes() > 0;
            one = {};
            if (begun)
                refuse(http::response(408), host, out);
            else
                out.send.push_back({port_, {}, host, {}, true});
        }
    }
    Time wake() const {
        Time first = Time::max();
        for (const auto& [host, one] : hosts_) first = std::min(first, one.deadline);
        return first;
    }
    std::uint64_t refused() const { return refused_; }

  private:
    static constexpr Time patience = std::chrono::seconds(5);
    struct Host {
        http::RequestReader reader;
        Time deadline = Time::max();  ///< of a request that is not whole, or has not begun
    };
    void refuse(Bytes response, Address host, Actions& out) {
        ++refused_;
        out.send.push_back({port_, std::move(response), host, {}, true});
    }

    std::size_t port_;
    std::map<Address, Host> hosts_;
    std::uint64_t refused_ = 0;
};

}  // namespace echoloop::waterlinked_family
