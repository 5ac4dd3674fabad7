// What happens in a run or stands in a capture, as messages on topics (docs/bags.md). Who gets them says
// which it wants, so that nothing is made in vain. On one thread; opens nothing.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "protocols/stream_decoder.h"
#include "tools/bag/messages.h"
#include "tools/bag/ping.h"
#include "tools/bag/sonar_picture.h"
#include "tools/said/said.h"

namespace echoloop::bag {

/// Bytes of one direction of a port, as they passed.
struct Wire {
    std::string device{}, port{};
    bool sent = false;     ///< by the device
    bool packets = false;  ///< a whole datagram
    double unix_time = 0;
    ByteView bytes{};
    std::size_t left_out = 0;  ///< of the message, at its end
    bool gap = false;          ///< bytes are missing before these
};

/// Of a run.
struct About {
    std::map<std::string, std::string> families{};  ///< of each device; one that is missing is guessed
    std::vector<std::string> objects{}, movers{};   ///< names in the scene, as TruthHeader has them
};

class Topics {
  public:
    struct Offer {
        const std::string& topic;
        const char* type;    ///< "sensor_msgs/msg/Image"
        std::uint64_t time;  ///< ns since 1970, when it was said
    };
    using Make = std::function<std::string()>;
    /// Calls `make` or not.
    using Take = std::function<void(const Offer& offer, const Make& make)>;

    Topics(About about, Take take) : about_(std::move(about)), take_(std::move(take)) {}

    void ping(const Ping& ping);
    /// Of a ping, what needs no echogram: the poses, and the lateness if it was late. Part of ping().
    void course(const Ping& ping);
    void bytes(const Wire& wire);
    void fault(const Fault& fault);
    /// Gives out what never became complete.
    void finish();

  private:
    struct Drawn {
        SonarPicture picture{};
        std::uint64_t time = 0;  ///< when it was offered last
    };
    struct Frequencies {
        long before = 0, last = 0;  ///< kHz, of the last two pings
        std::set<long> in_turn{};
    };
    struct Stream {
        std::unique_ptr<inspect::StreamDecoder> decoder{};
        Wire last{};  ///< without its bytes
    };

    std::string topic_of(const Ping& ping);
    void draw(const std::string& topic, const Stamped& head, std::uint64_t said, Levels levels);
    void offer_truth(const Ping& ping, const std::string& topic, const Stamped& head, std::uint64_t said);
    void message(const Wire& wire, const inspect::Family* family, const inspect::Message& message,
                 ByteView bytes);
    void end(Stream& stream);
    void say(const Wire& wire, const said::Picture& picture);

    About about_;
    Take take_;
    std::map<std::string, Drawn> drawn_{};                          ///< by topic
    std::map<std::string, Frequencies> frequencies_{};              ///< by device
    std::map<std::pair<std::string, bool>, Stream> streams_{};      ///< by port of a device, and direction
    std::map<std::string, std::unique_ptr<said::Maker>> makers_{};  ///< by device
};

}  // namespace echoloop::bag
