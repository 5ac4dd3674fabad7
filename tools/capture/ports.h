// The ports of a capture: who talks to whom on which line, connection or pair of addresses, and which of the
// two is the device. Knows no protocol family.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/capture/capture.h"

namespace echoloop::capture {

enum class PortKind { serial, tcp, udp };

/// What one of the two says.
struct SideCounts {
    std::uint64_t pieces = 0;  ///< datagrams, or stretches of a stream
    std::uint64_t bytes = 0;
};

/// A serial line, a port of an emulated device, or a pair of addresses.
struct PortKey {
    PortKind kind = PortKind::serial;
    std::string name{};         ///< of a line or of an emulated device's port; "" for a pair of addresses
    Address first{}, second{};  ///< a pair of addresses, the smaller one first
    friend auto operator<=>(const PortKey&, const PortKey&) = default;
};

/// Whose bytes an event holds, and on which port.
struct Origin {
    PortKey port;
    bool by_first = true;  ///< by the line's capturing side, the emulated device, or `first`
};

/// `of_ports`: of the capture's reader.
Origin origin_of(const CaptureEvent& event, bool of_ports);
/// The driver whose connection to a TCP port of an emulated device the event is of; empty for other ports.
std::optional<Address> driver_of(const CaptureEvent& event, const PortKey& port);
/// The bytes themselves.
ByteView bytes_of(const CaptureEvent& event);

struct PortSummary {
    PortKey key;
    SideCounts first, second;
    double begin = 0, end = 0;  ///< s, as in the events
    /// Of a TCP port of an emulated device, where several may have been at once: its drivers, and when each
    /// was heard or told something last.
    std::map<Address, double> drivers{};
    /// Certain where the capture says who speaks; else the side that says more is taken for the device.
    bool first_is_device() const;
    const SideCounts& device() const { return first_is_device() ? first : second; }
    const SideCounts& driver() const { return first_is_device() ? second : first; }
    std::string text() const;  ///< "micron line", "10.0.0.86:65500 - 10.0.1.102:4000 (UDP)"
};

/// What a capture holds, without its bytes.
struct Survey {
    std::vector<PortSummary> ports;  ///< in the order of their first events
    bool of_ports = false;
    double begin = 0;  ///< s, of the first event
    CaptureCounts counts;
    std::uint64_t cut = 0;         ///< datagrams of which the capture kept a part only
    std::uint64_t more_ports = 0;  ///< events of ports beyond the most that are kept apart
};

/// Reads a capture to its end, in bounded memory.
Survey survey(CaptureReader& capture);

/// Which ports a person means: a name, an address, a port number, or ADDRESS:PORT. More than one if an end of
/// all of them fits.
class PortFilter {
  public:
    explicit PortFilter(std::string text) : text_(std::move(text)) {}
    bool fits(const PortKey& port) const;
    /// A filter that names an end makes all its ports one; true if `first` of this port is that end. Empty if
    /// the filter names the port itself.
    std::optional<bool> end_is_first(const PortKey& port) const;

  private:
    bool fits_end(const Address& end) const;
    std::string text_;
};

}  // namespace echoloop::capture
