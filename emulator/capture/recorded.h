// A transport whose traffic goes into a recording as well. It changes neither bytes nor times.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "emulator/capture/envelope.h"
#include "emulator/capture/recording.h"
#include "emulator/transport/decorator.h"

namespace echoloop {

class Recorded final : public Decorator {
  public:
    /// Who uses the transport: a device, or a driver that has a device at the other end. Recorded is always
    /// how the device sees it.
    enum class Side { device, driver };
    /// `interface`: in the recording, for such a transport. `recording` outlives this.
    Recorded(std::unique_ptr<Transport> transport, Recording& recording, std::uint32_t interface,
             Side side = Side::device);
    /// An interface for `transport` and for others of the same port. `name`: e.g. "micron line".
    static std::uint32_t add_interface(Recording& recording, const Transport& transport,
                                       const std::string& name);

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

/// Records the wires of a device's ports: an interface for each port, for all of its drivers together.
class PortRecorder {
  public:
    /// `recording` outlives what this makes.
    PortRecorder(Recording& recording, std::string device)
        : recording_(&recording), device_(std::move(device)) {}
    std::unique_ptr<Transport> operator()(std::unique_ptr<Transport> wire, const Port& port);

  private:
    Recording* recording_;
    std::string device_;
    std::map<std::string, std::uint32_t> interfaces_;  ///< by the port's name
};

}  // namespace echoloop
