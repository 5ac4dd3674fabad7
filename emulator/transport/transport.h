// One end of a wire: bytes in, bytes out. It knows no protocol and no device.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulator/clock/asio.h"
#include "emulator/contract/device.h"
#include "emulator/transport/uart.h"

namespace echoloop {

/// What kind of wire it is, and its two ends where it is a network.
struct Wire {
    enum class Kind { serial, udp, tcp_server, tcp_client };
    Kind kind = Kind::serial;
    Address local, remote;  ///< remote: of the driver, or of whom is written to by default; zero if not known
};

class Transport {
  public:
    /// What a transport tells its session.
    struct Events {
        std::function<void(ByteView, Address from)> received;
        std::function<void()>
            reconnected;  ///< another driver is at the other end: half a frame is worthless now
        std::function<void(Address)> connected = [](Address) {};     ///< TCP, after reconnected
        std::function<void(Address)> disconnected = [](Address) {};  ///< TCP: who was connected
        std::function<void(double)> line_rate = [](double) {};  ///< pty: the driver has set another, bit/s
        std::function<void()> opened = [] {};                   ///< pty: a driver has it open now
    };

    Transport() = default;
    virtual ~Transport() = default;
    Transport(const Transport&) = delete;
    Transport& operator=(const Transport&) = delete;

    /// Begin to read; `events` are called on the io_context until close().
    virtual void start(Events events) = 0;
    /// Send all of `bytes`. With nobody at the other end they are lost, as on a wire. Never throws for that.
    virtual Task<void> write(ByteView bytes, Address to) = 0;
    /// A serial line: what is written from now on leaves at this rate, bit/s; 0: at the line's own, at which
    /// it listens all the time.
    virtual void speak_at(double /*rate*/) {}
    /// The device has lost its power: what is still to leave a serial line never does.
    virtual void cut_off() {}
    /// Ends the connection with whoever is at the other end; another may follow. A line has none. `to`: where
    /// several are, which of them; zero for all.
    virtual void hang_up(Address /*to*/) {}
    /// False while bytes would be lost because nobody is there to read them; true where nobody can know.
    virtual bool has_driver() const { return true; }
    /// A remark on the bytes that are written next, for a recording of them.
    virtual void annotate(const std::string& /*remark*/) {}
    /// The same on the bytes that `received` is being called with.
    virtual void annotate_received(const std::string& /*remark*/) {}
    /// The cable is pulled; whoever is at the other end finds out as the system lets them. Then it is put
    /// back.
    virtual void unplug() {}
    virtual void plug() {}
    /// TCP: ends the connection with a reset.
    virtual void reset() {}
    /// TCP: leaves the connection to itself, unread and unanswered; another may follow. Later it is reset.
    virtual void forget() {}
    virtual void reset_forgotten() {}
    virtual void close() = 0;
    /// The kernel is to hand over what it carries in either direction before this returns. Sockets do anyway.
    virtual void settle() {}
    /// What a person calls this place, e.g. "pty:/tmp/echoloop/micron -> /dev/pts/3".
    virtual std::string describe() const = 0;
    virtual Wire wire() const { return {}; }
    /// Who is at the other end, as a person calls them; empty where nobody is, or nobody can know.
    virtual std::vector<std::string> connected() const { return {}; }
    /// The UART of a driver on a serial line, where its settings can be seen; else its rate is 0.
    virtual uart::Receiver far_end() const { return {}; }
    /// bit/s at which what is written leaves a serial line; 0: as fast as the other end takes it.
    virtual double line_rate() const { return 0; }
    virtual std::uint64_t bytes_in() const = 0;
    virtual std::uint64_t bytes_out() const = 0;
    /// Bytes that a driver, though there, did not take: overrun, a full buffer, a refused datagram.
    virtual std::uint64_t bytes_lost() const { return 0; }
    /// Messages that such a driver misses as a whole, for too much waits for it already.
    virtual std::uint64_t messages_dropped() const { return 0; }
};

/// Counts for all transports.
class CountingTransport : public Transport {
  public:
    std::uint64_t bytes_in() const final { return in_; }
    std::uint64_t bytes_out() const final { return out_; }
    std::uint64_t bytes_lost() const final { return lost_; }

  protected:
    void count_in(std::size_t n) { in_ += n; }
    void count_out(std::size_t n) { out_ += n; }
    void count_lost(std::size_t n) { lost_ += n; }

  private:
    std::uint64_t in_ = 0, out_ = 0, lost_ = 0;
};

}  // namespace echoloop
