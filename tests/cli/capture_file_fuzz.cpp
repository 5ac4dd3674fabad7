// libFuzzer: any bytes as a file of captured traffic of whatever kind, to the ports and messages in it.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "emulator/contract/error.h"
#include "tools/capture/open.h"
#include "tools/capture/port_family.h"

using namespace echoloop;

namespace {

void read_all(const std::string& name) {
    capture::Input input(name);
    const auto file = capture::open_capture(input);
    const auto found = capture::survey(*file);
    for (const auto& port : found.ports) {
        capture::Input again(name);
        const auto reader = capture::open_capture(again, {.interval = 0.1, .as_sent = true});
        capture::family_of_port(*reader, {{port.key, port.first_is_device()}});
        break;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const int descriptor = ::memfd_create("capture", MFD_CLOEXEC);
    if (descriptor < 0 || ::write(descriptor, data, size) != static_cast<ssize_t>(size)) return 0;
    try {
        read_all("/proc/self/fd/" + std::to_string(descriptor));
    } catch (const StartError&) {
    }
    ::close(descriptor);
    return 0;
}
