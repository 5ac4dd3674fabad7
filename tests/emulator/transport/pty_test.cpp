// Real pseudo-terminals: what a driver finds when it opens, leaves and comes back.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "emulator/contract/error.h"
#include "emulator/transport/paced.h"
#include "emulator/transport/pty.h"
#include "tests/emulator/transport/pty_fixture.h"

namespace echoloop::test {
namespace {

TEST_F(PtyTest, LinkLeadsToARawTerminalAndGoesAtTheEnd) {
    const fs::path link = folder_ / "deep" / "er" / "sonar";
    {
        Pty pty(io_, link);
        ASSERT_TRUE(fs::is_symlink(link));
        const int fd = open_link(link);
        ASSERT_GE(fd, 0);
        termios settings{};
        ASSERT_EQ(::tcgetattr(fd, &settings), 0);
        EXPECT_EQ(settings.c_lflag & (ECHO | ICANON), 0u);
        EXPECT_EQ(settings.c_iflag & (ICRNL | IXON), 0u);
        ::close(fd);
    }
    EXPECT_FALSE(fs::exists(fs::symlink_status(link)));
}

TEST_F(PtyTest, BytesGoBothWaysUnchanged) {
    Pty pty(io_, folder_ / "sonar");
    start(pty);
    const int fd = open_link(folder_ / "sonar");
    ASSERT_TRUE(run_until([&] { return pty.opened(); }));
    Bytes all(256);
    for (int i = 0; i < 256; ++i) all[i] = static_cast<std::uint8_t>(i);
    write(pty, all);
    EXPECT_EQ(read_exactly(fd, all.size()), all);
    ASSERT_EQ(::write(fd, all.data(), all.size()), 256);
    run_until([&] { return heard_.size() == 256; });
    EXPECT_EQ(heard_, all);
    ::close(fd);
}

TEST_F(PtyTest, NoByteOfALongMessageIsLeftBehind) {
    Pty pty(io_, folder_ / "sonar");
    start(pty);
    const int driver = open_link(folder_ / "sonar");
    Bytes sent(40'000);
    for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<std::uint8_t>(i * 7 / 3);
    std::size_t written = 0;  // as much as the kernel takes at a time, twice in a row, and then it is read
    for (int burst = 0; written < sent.size() && burst < 100; ++burst) {
        for (int twice = 0; twice < 2; ++twice)
            written += static_cast<std::size_t>(
                std::max<ssize_t>(0, ::write(driver, sent.data() + written, sent.size() - written)));
        run_until([&] { return heard_.size() == written; });
    }
    EXPECT_EQ(heard_, sent);
    ::close(driver);
}

TEST_F(PtyTest, NothingIsKeptForADriverThatIsNotThere) {
    Pty pty(io_, folder_ / "sonar");
    start(pty);
    write(pty, Bytes(100, 0x55));
    int fd = open_link(folder_ / "sonar");
    ASSERT_TRUE(run_until([&] { return pty.opened(); }));
    write(pty, {1, 2, 3});
    EXPECT_EQ(read_exactly(fd, 3), (Bytes{1, 2, 3})) << "what was said to nobody is lost";
    write(pty, Bytes(100, 0x66));  // left unread
    ::close(fd);
    ASSERT_TRUE(run_until([&] { return !pty.opened(); }));
    EXPECT_EQ(reconnected_, 1);
    fd = open_link(folder_ / "sonar");
    ASSERT_TRUE(run_until([&] { return pty.opened(); }));
    write(pty, {4, 5, 6});
    EXPECT_EQ(read_exactly(fd, 3), (Bytes{4, 5, 6})) << "the next driver finds a clean line";
    ::close(fd);
}

TEST_F(PtyTest, ADriverThatReopensAtOnceLosesNeitherItsFirstWordsNorTheAnswer) {
    Pty pty(io_, folder_ / "sonar");
    start(pty);
    int fd = open_link(folder_ / "sonar");
    ASSERT_TRUE(run_until([&] { return pty.opened(); }));
    for (int time = 1; time <= 20; ++time) {
        write(pty, {9, 9, 9});  // left unread
        ::close(fd);
        fd = open_link(folder_ / "sonar");  // before the emulator has seen that it closed
        heard_.clear();
        ASSERT_EQ(::write(fd, "ab", 2), 2);
        ASSERT_TRUE(run_until([&] { return heard_.size() == 2; })) << time;
        EXPECT_EQ(reconnected_, time);
        write(pty, {1, 2, 3});
        EXPECT_EQ(read_exactly(fd, 3), (Bytes{1, 2, 3}));
    }
    ::close(fd);
}

TEST_F(PtyTest, ForeignFilesAreNeverReplaced) {
    const fs::path file = folder_ / "sonar";
    std::ofstream(file) << "precious";
    try {
        Pty pty(io_, file);
        FAIL() << "replaced a file";
    } catch (const StartError& error) {
        EXPECT_EQ(error.exit(), Exit::cannot_create);
        EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos);
    }
    std::string text;
    std::ifstream(file) >> text;
    EXPECT_EQ(text, "precious");
    Pty other(io_, folder_ / "taken");
    EXPECT_THROW(Pty(io_, folder_ / "taken"), StartError) << "a link in use";
    fs::create_symlink("/dev/null", folder_ / "null");
    EXPECT_THROW(Pty(io_, folder_ / "null"), StartError) << "a link to something else";
}

TEST_F(PtyTest, LeftOverLinkIsReplaced) {
    fs::create_symlink("/dev/pts/99999", folder_ / "sonar");
    Pty pty(io_, folder_ / "sonar");
    EXPECT_NE(fs::read_symlink(folder_ / "sonar"), "/dev/pts/99999");
}

TEST_F(PtyTest, ImpossibleDirectoryIsAStartError) {
    EXPECT_THROW(Pty(io_, "/proc/echoloop/sonar"), StartError);
    std::ofstream(folder_ / "file") << "x";
    EXPECT_THROW(Pty(io_, folder_ / "file" / "sonar"), StartError);
}

TEST_F(PtyTest, TheRateThatADriverSetsIsSeenAndOneThatItDoesNotSetIsNot) {
    Pty pty(io_, folder_ / "sonar");
    std::vector<double> told;
    Transport::Events events{[](ByteView, Address) {}, [] {}};
    events.line_rate = [&told](double rate) { told.push_back(rate); };
    pty.start(std::move(events));
    const int fd = open_link(folder_ / "sonar");
    ASSERT_TRUE(run_until([&] { return pty.opened(); }));
    termios settings{};
    ::tcgetattr(fd, &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(fd, TCSANOW, &settings);  // as a driver does that sets no rate
    EXPECT_EQ(pty.far_end().rate, 0);
    ::cfsetspeed(&settings, B57600);
    settings.c_iflag |= INPCK | IGNPAR | IGNBRK;
    ::tcsetattr(fd, TCSANOW, &settings);
    EXPECT_EQ(pty.far_end().rate, 57600);
    EXPECT_EQ(pty.far_end().framing_error, uart::BadByte::nothing);
    EXPECT_EQ(pty.far_end().line_break, uart::BadByte::nothing);
    write(pty, {1});
    write(pty, {2});
    EXPECT_EQ(told, std::vector<double>{57600}) << "once";
    ::close(fd);
}

TEST_F(PtyTest, ARateOutlivesTheDriverThatSetIt) {
    Pty pty(io_, folder_ / "sonar");
    start(pty);
    const fs::path link = folder_ / "sonar";
    ASSERT_EQ(std::system(("stty raw 19200 < " + link.string()).c_str()), 0);
    EXPECT_EQ(pty.far_end().rate, 19200) << "stty first, and then a program that sets nothing";
}

TEST_F(PtyTest, WhatADriverDoesNotReadInTimeIsCounted) {
    Pty pty(io_, folder_ / "sonar");
    start(pty);
    const int fd = open_link(folder_ / "sonar");
    ASSERT_TRUE(run_until([&] { return pty.opened(); }));
    constexpr std::size_t size = 100'000;
    write(pty, Bytes(size, 1));
    EXPECT_GT(pty.bytes_lost(), size / 2) << "the kernel keeps some 13 kB";
    EXPECT_EQ(pty.bytes_lost() + pty.bytes_out(), size);
    ::close(fd);
}

TEST_F(PtyTest, PacedLineIsNeverFasterThanItsRate) {
    auto pty = std::make_unique<Pty>(io_, folder_ / "sonar");
    Pty& line = *pty;
    RealClock clock(io_);
    Paced paced(clock, std::move(pty), 115200);
    start(paced);
    const int fd = open_link(folder_ / "sonar");
    ASSERT_TRUE(run_until([&] { return line.opened(); }));
    const auto begin = std::chrono::steady_clock::now();
    write(paced, Bytes(1200, 0x40));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_GE(took.count(), 12000 / 115200.0 - 1e-4);
    EXPECT_EQ(read_exactly(fd, 1200).size(), 1200u);
    ::close(fd);
}

}  // namespace
}  // namespace echoloop::test
