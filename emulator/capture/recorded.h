// A transport whose traffic goes into a recording as well. It changes neither bytes nor times.
#pragma once

#include <optional>

#include "emulator/capture/envelope.h"
#include "emulator/capture/recording.h"
#include "emulator/transport/transport.h"

namespace echoloop {

class Recorded final : public Transport {
  public:
    /// Who uses the transport: a device, or a driver that has a device at the other end. Recorded is always
    /// how the device sees it.
    enum class Side { device, driver };
    /// `name`: of the interface in the recording, e.g. "micron line". `recording` outlives this.
    Recorded(std::unique_ptr<Transport> line, Recording& recording, const std::string& name,
             Side side = Side::device);

    void start(Events events) override;
    /// Recorded is what really left, when its last byte left.
    Task<void> write(ByteView bytes, Address to) override;
    void hang_up() override { line_->hang_up(); }
    void close() override { line_->close(); }
    std::string describe() const override { return line_->describe(); }
    Wire wire() const override { return line_->wire(); }
    uart::Receiver far_end() const override { return line_->far_end(); }
    std::uint64_t bytes_in() const override { return line_->bytes_in(); }
    std::uint64_t bytes_out() const override { return line_->bytes_out(); }
    std::uint64_t bytes_lost() const override { return line_->bytes_lost(); }

  private:
    void begin_conversation();
    void record(ByteView bytes, bool ours, Address other);
    void add(pcapng::WallTime time, pcapng::Direction direction, ByteView packet);

    std::unique_ptr<Transport> line_;
    Recording& recording_;
    Side side_;
    Wire::Kind kind_;
    std::uint32_t interface_;
    std::optional<TcpConversation> conversation_;
};

}  // namespace echoloop
