// A pseudo-terminal that a driver opens like a serial port, behind a stable symbolic link. Never replaces a
// file that is not a link of its own; says nothing to a line that no driver has opened.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "emulator/transport/transport.h"
#include "emulator/transport/tty_arrivals.h"

namespace echoloop {

/// The symbolic link to a pty slave: made by the constructor, removed by the destructor if it is still ours.
class PtyLink {
  public:
    /// Makes missing directories. Replaces a dangling link or one to a pty that nobody holds. Throws
    /// StartError.
    PtyLink(std::filesystem::path link, std::filesystem::path slave);
    ~PtyLink();
    PtyLink(const PtyLink&) = delete;
    PtyLink& operator=(const PtyLink&) = delete;
    const std::filesystem::path& path() const { return link_; }

  private:
    std::filesystem::path link_, slave_;
};

class Pty final : public CountingTransport {
  public:
    /// Throws StartError if the pty or the link cannot be made.
    /// `group`: whose members may open it; "": the system's own rule.
    Pty(asio::io_context& io, const std::filesystem::path& link, std::string group = {});
    ~Pty() override;

    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    /// The terminal hangs up, as a pulled adapter's does, and its link is gone.
    void unplug() override;
    /// Another terminal behind the same link.
    void plug() override;
    void close() override;
    void settle() override;
    std::string describe() const override;
    uart::Receiver far_end() const override;
    /// True while a driver has the slave open.
    bool opened() const { return openers_ > 0; }
    bool has_driver() const override { return opened(); }
    std::vector<std::string> connected() const override;

  private:
    void open();
    void begin();
    Task<void> read_line();
    /// Passes on what has arrived; false if nothing has.
    bool hear();
    /// Passes on as much of what a driver said last, from `begin` on, as a small buffer of a device holds; of
    /// a flood the rest is lost. What the next one says already may be among it.
    void hear_last_words(ByteView begin);
    Task<void> watch_openers();
    void handle_watch(ByteView events);
    /// Takes note of who has opened and closed the slave by now.
    void note_openers();
    void recount();
    void drop_unread();
    /// Tells of a rate that the driver has set since the last time.
    void note_rate();

    asio::io_context& io_;
    int master_ = -1;  ///< -1: unplugged or closed
    TtyArrivals arrivals_;
    asio::posix::stream_descriptor watch_;  ///< inotify on the slave: open and close of drivers
    int watched_ = -1;                      ///< the slave's number in what it tells
    int slave_ = -1;                        ///< kept open, so that the master never reads EIO
    std::string slave_path_;
    std::filesystem::path wanted_link_;  ///< empty: none
    std::string group_;
    std::optional<PtyLink> link_;
    Events events_;
    int openers_ = 0;
    std::uint64_t visit_ = 0;  ///< how often the last driver has left
    bool has_left_ = false;    ///< and what it said last is not read yet
    double told_rate_ = 0;
};

}  // namespace echoloop
