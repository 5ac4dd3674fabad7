#include "emulator/capture/disk_file.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <utility>

#include "emulator/contract/error.h"

namespace echoloop {
namespace {

/// Device files and pipes may have several writers.
bool is_plain(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

/// False with errno set if the disk takes no more.
bool write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
}

/// The name of a scenario behind --record is a slip.
bool holds_something_else(const std::filesystem::path& file, std::string_view begins) {
    std::string held(begins.size(), '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(held.data(), static_cast<std::streamsize>(held.size()));
    held.resize(static_cast<std::size_t>(stream.gcount()));
    return !begins.starts_with(held);
}

/// Not through a link, which another user may have left where everybody may write; but a link to a pipe or a
/// device is how a shell hands those over (/dev/fd/63).
int open_for_writing(const std::filesystem::path& file) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0644);
    if (descriptor >= 0 || errno != ELOOP) return descriptor;
    const int behind = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
    if (behind < 0 || !is_plain(behind)) return behind;
    ::close(behind);
    errno = ELOOP;
    return -1;
}

/// After open_for_writing().
std::string why_not(const std::filesystem::path& file) {
    const int error = errno;
    std::error_code ec;
    return std::filesystem::is_symlink(file, ec) ? "it is a link; links are not followed"
                                                 : std::strerror(error);
}

}  // namespace

void DiskFile::refuse(const std::string& why) {
    close();
    throw StartError(Exit::cannot_create, file_.string() + ": " + why + "; name another file");
}

DiskFile::DiskFile(std::filesystem::path file, std::string_view begins)
    : file_(std::move(file)), descriptor_(open_for_writing(file_)) {
    if (descriptor_ < 0)
        throw StartError(Exit::cannot_create, file_.string() + ": cannot be written: " + why_not(file_) +
                                                  "; name a file in a folder that you may write to");
    if (!is_plain(descriptor_)) return;
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        refuse("is being written already, perhaps by another run");
    if (holds_something_else(file_, begins)) refuse("exists and holds something else, which would be lost");
    if (::ftruncate(descriptor_, 0) != 0) spdlog::debug("{}: {}", file_.string(), std::strerror(errno));
}

std::string DiskFile::append(std::string_view piece, std::uint64_t keep_free) {
    std::error_code ec;
    const auto space = std::filesystem::space(std::filesystem::absolute(file_).parent_path(), ec);
    if (!ec && space.available < keep_free + piece.size()) return "the disk is nearly full";
    if (!write_all(descriptor_, piece)) {
        std::string reason = std::strerror(errno);
        if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0)
            spdlog::debug("{} has a cut end", file_.string());
        return reason;
    }
    size_ += piece.size();
    return {};
}

void DiskFile::close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
}

void take_no_signals_for_files() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGPIPE);
    sigaddset(&signals, SIGXFSZ);
    ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

}  // namespace echoloop
