// The WebSocket protocol of Foxglove and Lichtblick (foxglove.sdk.v1, foxglove.websocket.v1): what a bag
// holds, as it happens. Knows no sockets; takes any text. A client that reads slowly gets the latest of each
// topic.
#pragma once

#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/bag/topics.h"

namespace echoloop::view {

/// The one of the protocols that a client offers which it will be answered in; "" if there is none.
std::string foxglove_protocol(std::string_view offered);

struct FoxgloveFrame {
    bool binary = false;
    std::shared_ptr<const std::string> bytes{};
    std::uint32_t channel = 0;  ///< of binary ones
};

class FoxgloveClient {
  public:
    /// What is to be sent next.
    std::optional<FoxgloveFrame> next();
    bool waits() const { return !waiting_.empty(); }

  private:
    friend class Foxglove;
    void push(FoxgloveFrame frame);

    std::map<std::uint32_t, std::uint32_t> subscriptions_{};  ///< by channel
    std::deque<FoxgloveFrame> waiting_{};
    std::size_t waiting_bytes_ = 0;
};

class Foxglove {
  public:
    explicit Foxglove(bag::About about);

    /// It gets what the server is and has.
    std::shared_ptr<FoxgloveClient> join();
    void leave(const std::shared_ptr<FoxgloveClient>& client) { clients_.remove(client); }
    bool has_clients() const { return !clients_.empty(); }
    /// What a client says: subscribe and unsubscribe; all else is left unanswered.
    static void hear(FoxgloveClient& client, const std::string& text);

    /// What happens in the run, for those who have subscribed to it.
    void ping(const bag::Ping& ping) { topics_.ping(ping); }
    void bytes(const bag::Wire& wire) { topics_.bytes(wire); }
    void fault(const bag::Fault& fault) { topics_.fault(fault); }

  private:
    struct Channel {
        std::string topic, type;
    };
    void take(const bag::Topics::Offer& offer, const bag::Topics::Make& make);
    std::string advertised(std::uint32_t first) const;

    std::list<std::shared_ptr<FoxgloveClient>> clients_{};
    std::vector<Channel> channels_{};  ///< number less one
    std::map<std::string, std::uint32_t> numbers_{};
    bag::Topics topics_;
};

}  // namespace echoloop::view
