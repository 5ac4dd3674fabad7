#include "emulator/capture/recording.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "emulator/error.h"

namespace echoloop {
namespace {

constexpr std::size_t enough_to_write = 1 << 20;
constexpr std::chrono::milliseconds longest_wait(500);  // what a kill -9 may lose

void append(Bytes& bytes, const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

std::filesystem::path numbered(const std::filesystem::path& file, std::size_t number) {
    if (number == 1) return file;
    auto name = file.stem();
    name += "-" + std::to_string(number);
    name += file.extension();
    return file.parent_path() / name;
}

int create(const std::filesystem::path& file) {
    return ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
}

/// False with errno set if the disk takes no more.
bool write_all(int descriptor, ByteView bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return true;
}

}  // namespace

Recording::Recording(std::filesystem::path file, RecordingLimits limits)
    : file_(std::move(file)),
      limits_(limits),
      start_time_(std::chrono::system_clock::now().time_since_epoch()),
      descriptor_(create(file_)) {
    if (descriptor_ < 0)
        throw StartError(Exit::cannot_create, file_.string() +
                                                  ": cannot be written: " + std::strerror(errno) +
                                                  "; name a file in a folder that you may write to");
    prologue_ = waiting_ = pcapng::section_header("echoloop");
    thread_ = std::jthread([this](std::stop_token stop) { keep_writing(stop); });
}

Recording::~Recording() { finish(); }

void Recording::finish() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
}

std::uint32_t Recording::add_interface(pcapng::LinkType type, const std::string& name,
                                       const std::string& description) {
    const Bytes block = pcapng::interface_description(type, name, description);
    const std::scoped_lock lock(mutex_);
    append(prologue_, block);
    append(waiting_, block);
    return interfaces_++;
}

void Recording::add(const pcapng::Packet& packet, ByteView bytes) {
    const Bytes block = pcapng::enhanced_packet(packet, bytes);
    const std::scoped_lock lock(mutex_);
    if (summary_.stopped) return;
    if (waiting_.size() + block.size() > limits_.most_waiting) {
        ++summary_.lost;
        return;
    }
    append(waiting_, block);
    ++summary_.packets;
    if (waiting_.size() >= enough_to_write) more_.notify_one();
}

pcapng::WallTime Recording::now() const {
    if (time_) return time_();
    return start_time_ + (std::chrono::steady_clock::now() - start_);
}

RecordingSummary Recording::summary() const {
    const std::scoped_lock lock(mutex_);
    return summary_;
}

void Recording::keep_writing(std::stop_token stop) {
    bool last = false;
    while (!last) {
        Bytes blocks;
        {
            std::unique_lock lock(mutex_);
            more_.wait_for(lock, stop, longest_wait, [this] { return waiting_.size() >= enough_to_write; });
            last = stop.stop_requested();
            blocks.swap(waiting_);
        }
        if (!blocks.empty() && descriptor_ >= 0) write(blocks);
    }
}

void Recording::write(const Bytes& blocks) {
    if (limits_.file_bytes > 0 && written_ >= limits_.file_bytes) open_file();
    if (descriptor_ < 0) return;
    if (!room_for(blocks.size())) return give_up("the disk is nearly full");
    if (!write_all(descriptor_, blocks)) {
        const std::string reason = std::strerror(errno);
        // Half a block would make the whole file suspect.
        if (::ftruncate(descriptor_, static_cast<off_t>(written_)) != 0)
            spdlog::debug("{} has a cut end", file_.string());
        return give_up(reason);
    }
    written_ += blocks.size();
    const std::scoped_lock lock(mutex_);
    summary_.bytes += blocks.size();
}

/// The next file of the row, with the blocks that make it readable by itself.
void Recording::open_file() {
    Bytes prologue;
    std::size_t number = 0;
    {
        const std::scoped_lock lock(mutex_);
        prologue = prologue_;
        number = ++summary_.files;
    }
    ::close(descriptor_);
    const auto name = numbered(file_, number);
    descriptor_ = create(name);
    written_ = 0;
    if (descriptor_ < 0) return give_up(name.string() + ": " + std::strerror(errno));
    if (!write_all(descriptor_, prologue)) return give_up(std::strerror(errno));
    written_ = prologue.size();
}

bool Recording::room_for(std::size_t bytes) const {
    std::error_code ec;
    const auto space = std::filesystem::space(std::filesystem::absolute(file_).parent_path(), ec);
    return ec || space.available >= limits_.keep_free + bytes;
}

void Recording::give_up(const std::string& reason) {
    spdlog::error(
        "{}: the recording has stopped: {}; the emulation goes on. Make room and start again to record",
        file_.string(), reason);
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
    const std::scoped_lock lock(mutex_);
    summary_.stopped = true;
    waiting_ = {};
}

}  // namespace echoloop
