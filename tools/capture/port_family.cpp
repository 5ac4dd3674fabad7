#include "tools/capture/port_family.h"

namespace echoloop::capture {
namespace {

constexpr std::size_t enough = std::size_t{512} << 10;  // B of a stream; of its datagrams as many

/// Guesses from what one side says, again whenever there is twice as much of it.
class Guess {
  public:
    const inspect::Family* add(ByteView bytes, bool datagram) {
        if (family_ != nullptr || seen_ > enough) return family_;
        seen_ += bytes.size() + 1;
        if (datagram) return family_ = inspect::guess_family(bytes);
        stream_.insert(stream_.end(), bytes.begin(), bytes.end());
        if (stream_.size() < look_at_) return nullptr;
        look_at_ = 2 * stream_.size();
        return family_ = inspect::guess_family(stream_);
    }
    const inspect::Family* last() const {
        return family_ != nullptr || stream_.empty() ? family_ : inspect::guess_family(stream_);
    }
    bool full() const { return seen_ > enough; }

  private:
    const inspect::Family* family_ = nullptr;
    Bytes stream_;
    std::size_t seen_ = 0, look_at_ = 1;
};

}  // namespace

const inspect::Family* family_of_port(CaptureReader& capture, const std::map<PortKey, bool>& sides) {
    Guess device, driver;
    while (const auto event = capture.next()) {
        const auto [key, by_first] = origin_of(*event, capture.of_ports());
        const auto side = sides.find(key);
        if (side == sides.end()) continue;
        const bool by_device = side->second == by_first;
        const bool datagram = std::holds_alternative<Datagram>(event->content);
        const auto* family = (by_device ? device : driver).add(bytes_of(*event), datagram);
        if (by_device && family != nullptr) return family;
        if (device.full()) break;
    }
    const auto* family = device.last();
    return family != nullptr ? family : driver.last();
}

}  // namespace echoloop::capture
