// libFuzzer: any bytes, over and over, as a file that is longer than a window: its messages must be those
// that all of it gives at once. The first byte chooses the family.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "tools/capture/input.h"
#include "tools/capture/stream_windows.h"

using namespace echoloop;

namespace {

struct Place {
    std::string name;
    std::size_t offset, size;
    friend bool operator==(const Place&, const Place&) = default;
};

/// Touching noise of one reason is one place, as decode_windows has it.
void add(std::vector<Place>& places, const inspect::Message& message) {
    const bool joins = !places.empty() && message.name.empty() && places.back().name == "?" + message.reason;
    if (joins) {
        places.back().size += message.size;
    } else {
        places.push_back(
            {message.name.empty() ? "?" + message.reason : message.name, message.offset, message.size});
    }
}

/// Silence with `part` where the first window has its last safe byte, and where it ends.
Bytes file_of(ByteView part, std::size_t before, const inspect::Family& family) {
    const std::size_t window = std::max(std::size_t{512} << 10, 2 * family.longest_frame);
    Bytes bytes(window + 2 * part.size() + 1000);
    for (const std::size_t place : {window - family.longest_frame, window})
        std::ranges::copy(part,
                          bytes.begin() + static_cast<std::ptrdiff_t>(place - std::min(before, part.size())));
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 16) return 0;
    const auto families = inspect::families();
    const auto& family = families[data[0] % families.size()];
    constexpr std::size_t most_frame = std::size_t{4}
                                       << 20;  // a window is twice that: a longer one takes seconds
    if (family.framing != inspect::Framing::stream || family.longest_frame > most_frame) return 0;
    const ByteView part(data + 2, std::min<std::size_t>(size - 2, family.longest_frame / 2));
    const Bytes bytes = file_of(part, data[1] * 4U, family);
    const int descriptor = ::memfd_create("bytes", MFD_CLOEXEC);
    if (descriptor < 0 ||
        ::write(descriptor, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
        return 0;
    std::vector<Place> all, windows;
    for (const auto& message : family.decode(bytes)) add(all, message);
    capture::Input input("/proc/self/fd/" + std::to_string(descriptor));
    const std::size_t read =
        capture::decode_windows(input, family, [&windows](const auto& message) { add(windows, message); });
    ::close(descriptor);
    if (read != bytes.size() || all != windows) std::abort();
    return 0;
}
