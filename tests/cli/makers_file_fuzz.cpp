// libFuzzer: any bytes behind the beginning of a maker's recording of one kind, ECHOLOOP_FILE, to its
// messages; as files hold them and as devices send them. What is read of a file that is not damaged must not
// be longer than the file allows.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "emulator/contract/error.h"
#include "tools/capture/messages.h"
#include "tools/capture/open.h"

using namespace echoloop;

namespace {

constexpr std::string_view kind = ECHOLOOP_FILE;

void put(Bytes& bytes, std::size_t at, std::initializer_list<int> values) {
    for (const int value : values) bytes[at++] = static_cast<std::uint8_t>(value);
}

void append_text(Bytes& bytes, std::string_view text) {
    bytes.insert(bytes.end(), {0, 0, 0, static_cast<std::uint8_t>(text.size())});
    bytes.insert(bytes.end(), text.begin(), text.end());
}

/// What the kind is known by; what follows is the fuzzer's.
Bytes beginning() {
    Bytes bytes;
    if (kind == "oculus_file") {
        bytes.resize(48);
        put(bytes, 0, {0x44, 0x33, 0x22, 0x11, 48, 0, 0, 0, 'O', 'c', 'u', 'l', 'u', 's'});
        put(bytes, 24, {1});
    } else if (kind == "aris_file") {
        bytes.resize(1024);
        put(bytes, 0, {0x44, 0x44, 0x46, 0x05});
    } else if (kind == "xtf_file") {
        bytes.resize(1024);
        put(bytes, 0, {0x7B});
        bytes.insert(bytes.end(), {0xCE, 0xFA, 3, 0, 0, 0, 0, 0, 0, 0, 64, 0, 0, 0});
        bytes.resize(1024 + 64);
    } else if (kind == "ping_viewer_log") {
        append_text(bytes, "PingViewer sensor log file");
        bytes.insert(bytes.end(), {0, 0, 0, 1});
        for (int i = 0; i < 5; ++i) append_text(bytes, "x");
        bytes.insert(bytes.end(), {0, 0, 0, 1, 0, 0, 0, 2});
    } else if (kind == "gzip_file") {
        bytes = {0x1F, 0x8B, 8, 0, 0, 0, 0, 0, 0, 3};
    } else if (kind == "kmall_file") {
        bytes = {26, 0, 0, 0, '#', 'I', 'I', 'P', 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 26, 0, 0, 0};
    }
    return bytes;
}

/// Messages may be a little longer than what carries them in a file, where headers come anew with each part,
/// and much longer where that was compressed.
void read_all(const std::string& name, bool as_sent, std::size_t size) {
    capture::Input input(name);
    const auto file = capture::open_capture(input, {.interval = 0, .as_sent = as_sent});
    std::size_t messages = 0, bytes = 0;
    capture::MessageSorter sorter(nullptr, [&](const auto&, const auto&) { ++messages; });
    double last = -HUGE_VAL;
    while (const auto event = file->next()) {
        if (event->time < last) std::abort();
        last = event->time;
        if (const auto* datagram = std::get_if<capture::Datagram>(&event->content))
            bytes += datagram->payload.size();
        else
            bytes += std::get<capture::StreamPiece>(event->content).bytes.size();
        sorter.add(*event);
    }
    sorter.finish();
    const bool packed = kind == "gzip_file" || kind == "oculus_file";
    if (!packed && bytes > 2 * size + 4096) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes = beginning();
    bytes.insert(bytes.end(), data, data + size);
    const int descriptor = ::memfd_create("recording", MFD_CLOEXEC);
    if (descriptor < 0 ||
        ::write(descriptor, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
        return 0;
    for (const bool as_sent : {false, true}) try {
            read_all("/proc/self/fd/" + std::to_string(descriptor), as_sent, bytes.size());
        } catch (const StartError&) {
        }
    ::close(descriptor);
    return 0;
}
