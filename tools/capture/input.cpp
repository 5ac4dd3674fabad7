#include "tools/capture/input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include "emulator/contract/error.h"
#include "emulator/scenario/file.h"
#include "tools/capture/inflate.h"

namespace echoloop::capture {
namespace {

constexpr std::size_t magic_size = 4;

/// Feeds libpcap from an Input's bytes already read, then from its file.
struct Replay {
    Bytes head;
    std::size_t at = 0;
    std::FILE* rest = nullptr;
};

ssize_t replay_read(void* cookie, char* buffer, std::size_t size) {
    auto& replay = *static_cast<Replay*>(cookie);
    if (replay.at == replay.head.size())
        return static_cast<ssize_t>(std::fread(buffer, 1, size, replay.rest));
    const auto count = std::min(size, replay.head.size() - replay.at);
    std::memcpy(buffer, replay.head.data() + replay.at, count);
    replay.at += count;
    return static_cast<ssize_t>(count);
}

int replay_close(void* cookie) {
    const std::unique_ptr<Replay> replay(static_cast<Replay*>(cookie));
    return replay->rest == stdin ? 0 : std::fclose(replay->rest);
}

}  // namespace

Input::Input(const std::string& name) : name_(name) {
    if (name == "-") {
        file_ = stdin;
    } else {
        if (const auto fault = scenario::file_fault(name)) {
            const bool permission = fault->kind == Problem::Kind::no_permission;
            throw StartError(permission ? Exit::no_permission : Exit::no_input,
                             scenario::in_quotes(name) + ": " + fault->message);
        }
        file_ = std::fopen(name.c_str(), "rbe");
        if (file_ == nullptr)
            throw StartError(Exit::no_input, scenario::in_quotes(name) + ": " + std::strerror(errno));
        struct stat status {};
        if (::fstat(::fileno(file_), &status) == 0) size_ = static_cast<std::uint64_t>(status.st_size);
        watched_ = ::fcntl(::fileno(file_), F_DUPFD_CLOEXEC, 3);
    }
    open_compressed();
}

void Input::open_compressed() {
    constexpr std::size_t marks = 6;
    const Bytes& start = peek(marks);
    if (const std::string other = other_compression(start); !other.empty())
        throw StartError(Exit::data, scenario::in_quotes(name_) + " is compressed by " + other +
                                         "; unpack it first (gzip is read as it is)");
    if (!is_gzip(start)) return;
    std::FILE* const stream = gunzipped(std::move(head_), file_, *fault_);
    if (stream == nullptr) throw StartError(Exit::unavailable, "cannot open a stream: out of memory");
    file_ = stream;
    head_.clear();
}

Input::~Input() {
    if (file_ != nullptr && file_ != stdin) std::fclose(file_);
    if (watched_ >= 0) ::close(watched_);
}

std::uint64_t Input::offset() const {
    const auto place = watched_ < 0 ? -1 : ::lseek(watched_, 0, SEEK_CUR);
    return place < 0 ? 0 : static_cast<std::uint64_t>(place);
}

const Bytes& Input::peek(std::size_t count) {
    if (head_.size() < count) head_ = read(count);
    return head_;
}

bool Input::is_capture() {
    constexpr std::uint8_t magics[][magic_size] = {{0xD4, 0xC3, 0xB2, 0xA1},
                                                   {0xA1, 0xB2, 0xC3, 0xD4},
                                                   {0x4D, 0x3C, 0xB2, 0xA1},
                                                   {0xA1, 0xB2, 0x3C, 0x4D},
                                                   {0x0A, 0x0D, 0x0D, 0x0A}};
    const auto start = ByteView(peek(magic_size)).first(std::min(head_.size(), magic_size));
    return std::ranges::any_of(magics, [&](const auto& magic) { return std::ranges::equal(start, magic); });
}

Bytes Input::read(std::size_t count) {
    const auto have = std::min(count, head_.size());
    Bytes bytes(count);
    std::copy_n(head_.begin(), have, bytes.begin());
    head_.erase(head_.begin(), head_.begin() + static_cast<std::ptrdiff_t>(have));
    bytes.resize(have + std::fread(bytes.data() + have, 1, count - have, file_));
    if (std::ferror(file_) != 0)
        throw StartError(Exit::io, "cannot read " + scenario::in_quotes(name_) + ": " + std::strerror(errno));
    return bytes;
}

std::FILE* Input::release() {
    auto replay = std::make_unique<Replay>(Replay{std::move(head_), 0, file_});
    std::FILE* stream = ::fopencookie(replay.get(), "rb", {replay_read, nullptr, nullptr, replay_close});
    if (stream == nullptr) throw StartError(Exit::unavailable, "cannot open a stream: out of memory");
    static_cast<void>(replay.release());  // replay_close owns it now
    file_ = nullptr;
    return stream;
}

}  // namespace echoloop::capture
