// A transport whose traffic goes into a recording as well. It changes neither bytes nor times.
#pragma once

#include <optional>

#include "emulator/capture/envelope.h"
#include "emulator/capture/recording.h"
#include "emulator/transport/decorator.h"

namespace echoloop {

class Recorded final : public Decorator {
  public:
    /// Who uses the transport: a device, or a driver that has a device at the other end. Recorded is always
    /// how the device sees it.
    enum class Side { device, driver };
    /// `name`: of the interface in the recording, e.g. "micron line". `recording` outlives this.
    Recorded(std::unique_ptr<Transport> transport, Recording& recording, const std::string& name,
             Side side = Side::device);

    void start(Events events) override;
    /// Recorded is what really left, when its last byte left.
    Task<void> write(ByteView bytes, Address to) override;
    /// Becomes the comment of the next packet that is sent.
    void annotate(const std::string& remark) override;
    void annotate_received(const std::string& remark) override;

  private:
    void begin_conversation();
    void record(ByteView bytes, bool ours, Address other, pcapng::WallTime time);
    void add(pcapng::WallTime time, pcapng::Direction direction, ByteView packet,
             std::string* remarks = nullptr);

    Recording& recording_;
    Side side_;
    Wire::Kind kind_;
    std::uint32_t interface_;
    std::string remarks_, remarks_on_received_;
    std::optional<TcpConversation> conversation_;
};

}  // namespace echoloop
