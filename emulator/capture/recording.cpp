#include "emulator/capture/recording.h"

#include <spdlog/spdlog.h>

#include "emulator/contract/error.h"

namespace echoloop {
namespace {

constexpr std::string_view magic = "\x0A\x0D\x0D\x0A";  // of pcapng

void append(Bytes& bytes, const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

std::string_view text_of(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::filesystem::path numbered(const std::filesystem::path& file, std::size_t number) {
    if (number == 1) return file;
    auto name = file.stem();
    name += "-" + std::to_string(number);
    name += file.extension();
    return file.parent_path() / name;
}

}  // namespace

Recording::Recording(std::filesystem::path file, RecordingLimits limits)
    : file_(std::move(file)),
      limits_(limits),
      start_time_(std::chrono::system_clock::now().time_since_epoch()),
      disk_(std::in_place, file_, magic) {
    prologue_ = waiting_ = pcapng::section_header("echoloop");
    start_writing();
}

Recording::Recording(RecordingLimits limits)
    : limits_(limits), start_time_(std::chrono::system_clock::now().time_since_epoch()), idle_(true) {
    prologue_ = pcapng::section_header("echoloop");
}

void Recording::begin(std::filesystem::path file) {
    finish();
    disk_.emplace(file, magic);
    const std::scoped_lock lock(mutex_);
    file_ = std::move(file);
    summary_ = {};
    waiting_ = prologue_;
    idle_ = false;
    start_writing();
}

void Recording::start_writing() {
    thread_ = std::jthread([this](std::stop_token stop) { keep_writing(stop); });
}

Recording::~Recording() { finish(); }

void Recording::finish() {
    if (!thread_.joinable()) return;
    idle_ = true;
    thread_.request_stop();
    thread_.join();
    disk_.reset();
}

std::uint32_t Recording::add_interface(pcapng::LinkType type, const std::string& name,
                                       const std::string& description) {
    const Bytes block = pcapng::interface_description(type, name, description);
    const std::scoped_lock lock(mutex_);
    append(prologue_, block);
    if (!idle_) append(waiting_, block);
    return interfaces_++;
}

void Recording::add(const pcapng::Packet& packet, ByteView bytes) {
    if (idle_) return;
    const Bytes block = pcapng::enhanced_packet(packet, bytes);
    const std::scoped_lock lock(mutex_);
    if (summary_.stopped || idle_) return;
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
    take_no_signals_for_files();
    bool last = false;
    while (!last) {
        Bytes blocks;
        {
            std::unique_lock lock(mutex_);
            more_.wait_for(lock, stop, longest_wait, [this] { return waiting_.size() >= enough_to_write; });
            last = stop.stop_requested();
            blocks.swap(waiting_);
        }
        if (!blocks.empty() && disk_) write(blocks);
    }
}

void Recording::write(const Bytes& blocks) {
    if (limits_.file_bytes > 0 && disk_->size() >= limits_.file_bytes) open_file();
    if (!disk_) return;
    if (const auto reason = disk_->append(text_of(blocks), limits_.keep_free); !reason.empty())
        return give_up(reason);
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
    try {
        disk_.emplace(numbered(file_, number), magic);
    } catch (const StartError& error) {
        return give_up(error.what());
    }
    if (const auto reason = disk_->append(text_of(prologue), limits_.keep_free); !reason.empty())
        give_up(reason);
}

void Recording::give_up(const std::string& reason) {
    spdlog::error(
        "{}: the recording has stopped: {}; the emulation goes on. Make room and start again to record",
        file_.string(), reason);
    disk_.reset();
    const std::scoped_lock lock(mutex_);
    summary_.stopped = true;
    waiting_ = {};
}

}  // namespace echoloop
