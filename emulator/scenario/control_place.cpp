#include "emulator/scenario/control_place.h"

#include <stdexcept>

#include "emulator/contract/endpoint.h"

namespace echoloop {

ControlPlace parse_control_place(std::string_view text) {
    constexpr std::string_view unix = "unix:";
    constexpr std::size_t longest_path = 107;  // what the system takes
    if (text.starts_with(unix)) {
        const std::string path(text.substr(unix.size()));
        if (path.empty() || path.front() != '/')
            throw std::invalid_argument("unix: needs an absolute path, as in unix:/tmp/echoloop/control");
        if (path.size() > longest_path)
            throw std::invalid_argument("unix: the path is longer than the 107 bytes that a socket may have");
        if (path.find('\0') != std::string::npos)
            throw std::invalid_argument("the path holds a zero character");
        return {path, {}};
    }
    if (!text.starts_with("tcp-listen://"))
        throw std::invalid_argument(
            "expected a place to be controlled from, as in unix:/tmp/echoloop/control or "
            "tcp-listen://127.0.0.1:9600");
    const Endpoint endpoint = parse_endpoint(text);
    if (endpoint.ip >> 24 != 127)
        throw std::invalid_argument(
            "a run is controlled from its own machine only; name an address of 127.0.0.0/8");
    return {{}, {endpoint.ip, endpoint.port}};
}

}  // namespace echoloop
