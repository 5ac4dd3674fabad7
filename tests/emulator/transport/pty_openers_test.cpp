// How many drivers have a pseudo-terminal open, also when they come and go while the emulator does not look.
#include <fstream>

#include "emulator/transport/pty.h"
#include "tests/emulator/transport/pty_fixture.h"

namespace echoloop::test {
namespace {

TEST_F(PtyTest, OneOfTwoThatOpenedItBeforeAnybodyLookedMayLeave) {
    Pty pty(io_, folder_ / "sonar");
    start(pty);
    const int stays = open_link(folder_ / "sonar");
    const int leaves = open_link(folder_ / "sonar");
    ASSERT_TRUE(run_until([&] { return pty.opened(); }));
    ::close(leaves);
    // Whoever asks the line for bytes has seen by then who is there.
    ASSERT_EQ(::write(stays, "a", 1), 1);
    ASSERT_TRUE(run_until([&] { return !heard_.empty(); }));
    EXPECT_TRUE(pty.opened());
    EXPECT_EQ(reconnected_, 0);
    write(pty, {1, 2, 3});
    EXPECT_EQ(read_exactly(stays, 3), (Bytes{1, 2, 3}));
    ::close(stays);
    EXPECT_TRUE(run_until([&] { return !pty.opened(); }));
}

TEST_F(PtyTest, TwoThatLeaveBeforeAnybodyLooksHaveBothLeft) {
    Pty pty(io_, folder_ / "sonar");
    start(pty);
    const int one = open_link(folder_ / "sonar");
    ASSERT_TRUE(run_until([&] { return pty.opened(); }));
    const int other = open_link(folder_ / "sonar");
    ASSERT_EQ(::write(other, "a", 1), 1);
    ASSERT_TRUE(run_until([&] { return !heard_.empty(); }));
    ::close(one);
    ::close(other);
    EXPECT_TRUE(run_until([&] { return !pty.opened(); }));
    EXPECT_EQ(reconnected_, 1);
}

/// Opens and closes until inotify forgets.
void come_and_go_too_often(const fs::path& link) {
    int remembered = 0;
    std::ifstream("/proc/sys/fs/inotify/max_queued_events") >> remembered;
    for (int i = 0; i < remembered; ++i) ::close(::open(link.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK));
}

TEST_F(PtyTest, WhoIsThereIsKnownAfterMoreHaveComeAndGoneThanTheKernelRemembers) {
    Pty pty(io_, folder_ / "sonar");
    start(pty);
    come_and_go_too_often(folder_ / "sonar");
    const int driver = open_link(folder_ / "sonar");  // untold
    ASSERT_TRUE(run_until([&] { return pty.opened(); }));
    write(pty, {1, 2, 3});
    EXPECT_EQ(read_exactly(driver, 3), (Bytes{1, 2, 3}));
    come_and_go_too_often(folder_ / "sonar");
    ::close(driver);  // untold
    EXPECT_TRUE(run_until([&] { return !pty.opened(); }));
}

}  // namespace
}  // namespace echoloop::test
