#include "emulator/transport/pty.h"

#include <fcntl.h>
#include <grp.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <stdlib.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "emulator/contract/error.h"
#include "emulator/transport/far_end.h"

namespace echoloop {
namespace {

[[noreturn]] void fail(const std::string& what, int error, const char* remedy = "") {
    throw StartError(Exit::unavailable, "pseudo-terminal: " + what + ": " + std::strerror(error) + remedy);
}

constexpr const char* pty_remedy =
    "; see that /dev/pts is mounted (mount -t devpts devpts /dev/pts) and that /dev/ptmx is a link to "
    "pts/ptmx, "
    "or use a tcp-listen:// or udp-listen:// endpoint";

/// The master side of a new pseudo-terminal, non-blocking.
int open_master() {
    const int fd = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) fail("/dev/ptmx cannot be opened", errno, pty_remedy);
    if (::grantpt(fd) != 0 || ::unlockpt(fd) != 0) {
        const int error = errno;
        ::close(fd);
        fail("/dev/ptmx makes none", error, pty_remedy);
    }
    return fd;
}

std::string slave_name(int master) {
    std::array<char, 128> name{};
    if (::ptsname_r(master, name.data(), name.size()) != 0) fail("has no name", errno);
    return name.data();
}

/// To be opened by the members of `group`, as a real serial port is.
void give_to(const std::string& group, const std::string& slave) {
    const struct group* const entry = ::getgrnam(group.c_str());
    if (entry == nullptr)
        throw StartError(Exit::config, "pseudo-terminal: there is no group " + group +
                                           "; name one that `getent group` shows, e.g. dialout");
    if (::chown(slave.c_str(), static_cast<uid_t>(-1), entry->gr_gid) != 0 ||
        ::chmod(slave.c_str(), S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP) != 0)
        throw StartError(Exit::no_permission, "pseudo-terminal: it cannot be given to the group " + group +
                                                  ": " + std::strerror(errno) +
                                                  "; add this user to the group");
}

/// Raw, 8 bits, no echo: a driver that sets nothing still gets its bytes unchanged.
int open_raw_slave(const std::string& path) {
    const int fd = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (fd < 0) fail(path + " cannot be opened", errno, pty_remedy);
    termios settings{};
    ::tcgetattr(fd, &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(fd, TCSANOW, &settings);
    mark_unset(fd);
    return fd;
}

struct Watch {
    int fd;
    int terminal;  ///< the number that events of the slave bear
};

/// The slave and its folder. Events of the folder come between those of the slave and keep them apart:
/// inotify makes one of two that are the same and come one after the other (inotify(7)).
Watch open_watch(const std::filesystem::path& slave) {
    const int fd = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (fd < 0) fail("inotify cannot be opened (raise fs.inotify.max_user_instances)", errno);
    const auto add = [fd](const std::filesystem::path& path) {
        const int number = ::inotify_add_watch(fd, path.c_str(), IN_OPEN | IN_CLOSE);
        if (number >= 0) return number;
        const int error = errno;
        ::close(fd);
        fail(path.string() + " cannot be watched (raise fs.inotify.max_user_watches)", error);
    };
    add(slave.parent_path());
    return {fd, add(slave)};
}

}  // namespace

Pty::Pty(asio::io_context& io, const std::filesystem::path& link, std::string group)
    : io_(io), arrivals_(io), watch_(io), wanted_link_(link), group_(std::move(group)) {
    open();
}

void Pty::open() {
    master_ = open_master();
    arrivals_.watch(master_);
    slave_path_ = slave_name(master_);
    if (!group_.empty()) give_to(group_, slave_path_);
    slave_ = open_raw_slave(slave_path_);
    const Watch watch = open_watch(slave_path_);
    watch_.assign(watch.fd);
    watched_ = watch.terminal;
    if (!wanted_link_.empty()) link_.emplace(wanted_link_, slave_path_);
}

Pty::~Pty() { close(); }

void Pty::close() {
    error_code ignored;
    watch_.close(ignored);
    arrivals_.close();
    for (int* side : {&master_, &slave_})
        if (const int fd = std::exchange(*side, -1); fd >= 0) ::close(fd);
    link_.reset();
}

void Pty::settle() {
    // A work queue carries bytes from one side to the other; who polls a side that has none waits for it.
    std::array<pollfd, 2> sides{{{master_, POLLIN, 0}, {slave_, POLLIN, 0}}};
    ::poll(sides.data(), sides.size(), 0);
    // Who reads finds bytes a moment before epoll knows of them, which is enough to miss a step.
    while (events_.received && hear()) continue;
}

void Pty::unplug() {
    link_.reset();  // first, so that who notices the hang-up finds it gone
    close();
    openers_ = 0;
}

void Pty::plug() {
    if (master_ >= 0) return;
    try {
        open();
        begin();
        events_.reconnected();
    } catch (const StartError& error) {
        spdlog::error("{}; it stays unplugged", error.what());
    }
}

void Pty::start(Events events) {
    events_ = std::move(events);
    begin();
}

void Pty::begin() {
    asio::co_spawn(io_, read_line(), Serving(describe()));
    asio::co_spawn(io_, watch_openers(), Serving(describe()));
}

Task<void> Pty::read_line() {
    error_code ec;
    while (master_ >= 0) {
        co_await arrivals_.wait(ec);
        if (ec) co_return;
        hear();
    }
}

bool Pty::hear() {
    std::array<std::uint8_t, 4096> buffer;  // a terminal holds fewer (N_TTY_BUF_SIZE): one read takes all
    const ssize_t n = master_ < 0 ? 0 : ::read(master_, buffer.data(), buffer.size());
    if (n <= 0) return false;
    count_in(static_cast<std::size_t>(n));
    const ByteView bytes = ByteView(buffer).first(static_cast<std::size_t>(n));
    note_openers();  // who came before these bytes must not lose them to who left
    if (has_left_) {
        hear_last_words(bytes);
        return true;
    }
    note_rate();
    events_.received(bytes, {});
    return true;
}

Task<void> Pty::watch_openers() {
    error_code ec;
    while (watch_.is_open()) {
        co_await watch_.async_wait(asio::posix::descriptor_base::wait_read, into(ec));
        if (ec) co_return;
        note_openers();
        if (has_left_) hear_last_words({});
    }
}

void Pty::hear_last_words(ByteView begin) {
    constexpr std::size_t longest = 1024, most = 256 << 10;  // most: more than the kernel holds
    has_left_ = false;
    Bytes last(begin.begin(), begin.end());
    std::array<std::uint8_t, 4096> buffer;
    std::size_t read = 0;
    for (ssize_t n; read < most && master_ >= 0 && (n = ::read(master_, buffer.data(), buffer.size())) > 0;) {
        count_in(static_cast<std::size_t>(n));
        read += static_cast<std::size_t>(n);
        const std::size_t kept =
            std::min(static_cast<std::size_t>(n), longest - std::min(longest, last.size()));
        last.insert(last.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(kept));
    }
    last.resize(std::min(last.size(), longest));
    note_rate();
    if (!last.empty()) events_.received(last, {});
}

void Pty::note_openers() {
    alignas(inotify_event) std::array<std::uint8_t, 4096> buffer;
    while (watch_.is_open()) {
        const ssize_t n = ::read(watch_.native_handle(), buffer.data(), buffer.size());
        if (n <= 0) return;
        handle_watch(ByteView(buffer).first(static_cast<std::size_t>(n)));
    }
}

void Pty::handle_watch(ByteView events) {
    while (events.size() >= sizeof(inotify_event)) {
        inotify_event event;
        std::memcpy(&event, events.data(), sizeof event);
        events = events.subspan(std::min(events.size(), sizeof event + event.len));
        if (event.mask & IN_Q_OVERFLOW) recount();
        if (event.wd != watched_) continue;
        if ((event.mask & IN_OPEN) && openers_++ == 0) events_.opened();
        if (event.mask & IN_CLOSE) openers_ = std::max(0, openers_ - 1);
        if ((event.mask & IN_CLOSE) && openers_ == 0) {
            drop_unread();
            ++visit_;
            has_left_ = true;
            events_.reconnected();
        }
    }
}

/// More drivers came and went unseen than the kernel remembers. The master hangs up when nobody has the slave
/// open, so it is let go for a moment.
void Pty::recount() {
    ::close(slave_);
    pollfd master{master_, 0, 0};
    ::poll(&master, 1, 0);
    slave_ = ::open(slave_path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    std::array<std::uint8_t, 4096> own;  // what is told of this
    while (::read(watch_.native_handle(), own.data(), own.size()) > 0) continue;
    openers_ = 0;
    drop_unread();
    ++visit_;
    has_left_ = true;
    events_.reconnected();
    if (master.revents & POLLHUP) return;
    openers_ = 1;
    events_.opened();
}

/// What a driver left unread must not reach the next one.
void Pty::drop_unread() {
    ::tcflush(slave_, TCIFLUSH);
    ::ioctl(master_, TCFLSH, TCOFLUSH);
}

uart::Receiver Pty::far_end() const { return slave_ >= 0 ? echoloop::far_end(slave_) : uart::Receiver{}; }

void Pty::note_rate() {
    const double rate = far_end().rate;
    if (rate <= 0 || rate == told_rate_) return;
    told_rate_ = rate;
    events_.line_rate(rate);
}

Task<void> Pty::write(ByteView bytes, Address) {
    const std::uint64_t visit = visit_;  // bytes for who leaves are for nobody else
    note_openers();
    if (opened()) note_rate();
    // The kernel buffers some 13 kB. A driver that has not read for this long loses bytes, as with a UART's
    // overrun.
    constexpr std::chrono::milliseconds patience(200), pause(2);
    const auto give_up = std::chrono::steady_clock::now() + patience;
    const std::string terminal = slave_path_;
    while (!bytes.empty() && opened() && master_ >= 0 && terminal == slave_path_ && visit == visit_) {
        const ssize_t n = ::write(master_, bytes.data(), bytes.size());
        if (n > 0) {
            count_out(static_cast<std::size_t>(n));
            bytes = bytes.subspan(static_cast<std::size_t>(n));
            continue;
        }
        if (errno != EAGAIN || std::chrono::steady_clock::now() > give_up) {
            count_lost(bytes.size());
            co_return;
        }
        asio::steady_timer timer(io_, pause);
        error_code ec;
        co_await timer.async_wait(into(ec));
    }
}

std::vector<std::string> Pty::connected() const {
    if (!opened()) return {};
    return {"on " + (link_ ? link_->path().string() : slave_path_)};
}

std::string Pty::describe() const {
    return link_ ? "pty:" + link_->path().string() + " -> " + slave_path_ : "pty " + slave_path_;
}

}  // namespace echoloop
