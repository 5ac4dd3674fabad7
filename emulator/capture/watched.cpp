#include "emulator/capture/watched.h"

#include <algorithm>
#include <utility>

namespace echoloop {

Watched::Watched(std::unique_ptr<Transport> transport, Watch& watch, std::string device, std::string port)
    : Decorator(std::move(transport)),
      watch_(watch),
      device_(std::move(device)),
      port_(std::move(port)),
      packets_(line().wire().kind == Wire::Kind::udp) {}

void Watched::start(Events events) {
    Events ours = events;
    ours.received = [this, received = std::move(events.received)](ByteView bytes, Address from) {
        tell(false, bytes);
        received(bytes, from);
    };
    line().start(std::move(ours));
}

Task<void> Watched::write(ByteView bytes, Address to) {
    const std::uint64_t before = line().bytes_out();
    co_await line().write(bytes, to);
    const std::uint64_t gone = line().bytes_out() - before;
    if (gone > 0) tell(true, bytes.first(std::min<std::size_t>(bytes.size(), gone)));
}

void Watched::tell(bool sent, ByteView bytes) {
    watch_.bytes({device_, port_, sent, packets_, bytes, line().line_rate()});
}

}  // namespace echoloop
