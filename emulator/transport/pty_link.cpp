#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "emulator/contract/error.h"
#include "emulator/transport/own_folder.h"
#include "emulator/transport/pty.h"

namespace echoloop {
namespace fs = std::filesystem;
namespace {

/// A link to a pty slave whose emulator is gone: the slave is missing, has no master, or was given to us
/// meanwhile.
bool is_stale_pty_link(const fs::path& link, const fs::path& our_slave) {
    std::error_code ec;
    if (!fs::is_symlink(link, ec)) return false;
    const fs::path target = fs::read_symlink(link, ec);
    if (ec || target.string().rfind("/dev/pts/", 0) != 0) return false;
    if (target == our_slave || !fs::exists(target, ec)) return true;
    const int fd = ::open(target.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (fd >= 0) ::close(fd);
    return fd < 0 && (errno == EIO || errno == ENXIO || errno == ENOENT);
}

std::string other_link() { return "pty:" + (place_of_ones_own() / "micron").string(); }

/// Why a link cannot be made where something is, and what to do.
std::string taken(const fs::path& link) {
    std::error_code ec;
    const auto target = fs::read_symlink(link, ec);
    const std::string other = "; name another link in the endpoint";
    if (!ec && target.string().rfind("/dev/pts/", 0) == 0)
        return ": exists already and leads to " + target.string() +
               ", which somebody has open: perhaps another run" + other + ", or end that run";
    if (!ec) return ": exists already and leads to " + target.string() + other + ", or remove it";
    return std::string(": exists already and is a ") + (fs::is_directory(link, ec) ? "folder" : "file") +
           other;
}

}  // namespace

PtyLink::PtyLink(fs::path link, fs::path slave) : link_(std::move(link)), slave_(std::move(slave)) {
    make_own_folder(link_.parent_path(), "the pty link", other_link());
    std::error_code ec;
    if (is_stale_pty_link(link_, slave_)) fs::remove(link_, ec);
    fs::create_symlink(slave_, link_, ec);
    if (!ec) return;
    if (ec == std::errc::file_exists) throw StartError(Exit::cannot_create, link_.string() + taken(link_));
    const bool denied = ec == std::errc::permission_denied || ec == std::errc::read_only_file_system;
    throw StartError(denied ? Exit::no_permission : Exit::cannot_create,
                     link_.string() + ": pty link cannot be made: " + ec.message() +
                         "; name a place that you may write in the endpoint, e.g. " + other_link());
}

PtyLink::~PtyLink() {
    std::error_code ec;
    if (fs::read_symlink(link_, ec) == slave_ && !ec) fs::remove(link_, ec);
}

}  // namespace echoloop
