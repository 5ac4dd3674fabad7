// The URI of one place where a device meets the world. Parses and prints; opens nothing, looks no host name
// up.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace echoloop {

/// Where poses and steps may come from as well, the answers going to standard output. No device has it.
inline constexpr std::string_view standard_input = "stdin";

/// A parsed endpoint:
///     pty:/tmp/echoloop/micron            a pseudo-terminal with a link of that name
///         ?baud_check=off                 the driver may set any rate (on: a wrong one makes garbage)
///         ?usb_latency=16                 bytes come as from a USB adapter with that latency timer, ms
///         ?group=dialout                  the members of that group may open it, not only its user
///     serial:///dev/ttyUSB0:115200        a real serial port; without a rate: the device's own
///     tcp-listen://127.0.0.1:9090         tcp://127.0.0.1:9090
///         ?idle=10                        a driver that says and takes nothing for this time, s, makes way
///                                         for another; off: never
///     udp-listen://127.0.0.1:65500        udp://127.0.0.1:65400?local_port=65502
struct Endpoint {
    enum class Scheme { pty, serial, tcp_listen, tcp, udp_listen, udp };

    Scheme scheme = Scheme::pty;
    std::string path;        ///< pty, serial: absolute
    std::string host;        ///< others: dotted IPv4; "localhost" has become 127.0.0.1
    std::uint32_t ip = 0;    ///< the same in host byte order
    std::uint16_t port = 0;  ///< 0 (listening only): the system chooses
    std::uint32_t baud = 0;  ///< serial: bit/s; 0: the device's own rate
    std::map<std::string, std::string, std::less<>> query;

    /// The port a sender binds (`?local_port=`); 0: the system chooses.
    std::uint16_t local_port() const;
    /// pty: whether a rate that is not the device's makes garbage of its bytes.
    bool checks_baud() const;
    /// pty: latency timer of a USB adapter, ms; 0: none.
    std::uint32_t usb_latency() const;
    /// tcp-listen: s that a driver may say and take nothing before another may have its place;
    /// none: for ever.
    std::optional<double> idle() const;
    /// pty: the group that may open it, as one may a real serial port; "": the system's own rule.
    std::string group() const;
    bool on_udp() const { return scheme == Scheme::udp || scheme == Scheme::udp_listen; }
    bool listens() const { return scheme == Scheme::tcp_listen || scheme == Scheme::udp_listen; }
    friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

/// Throws std::invalid_argument with a sentence for the user: what is wrong and what would be right.
Endpoint parse_endpoint(std::string_view uri);
std::vector<Endpoint> parse_endpoints(std::span<const std::string> uris);

/// Line rate, bit/s, of a device: of its slowest real serial port, which has the rate of its endpoint, or
/// else `baud`, or else the usual 115200; without such a port `baud`, which is 0 where the line follows its
/// driver or is not paced.
double line_rate(std::span<const Endpoint> endpoints, double baud);

/// "pty", "serial", "tcp-listen", "tcp", "udp-listen", "udp".
std::string_view scheme_name(Endpoint::Scheme scheme);

/// The canonical form; parse_endpoint(to_string(e)) == e.
std::string to_string(const Endpoint& endpoint);

/// True if both would claim the same link, serial port or listening port of this machine.
bool clash(const Endpoint& a, const Endpoint& b);

}  // namespace echoloop
