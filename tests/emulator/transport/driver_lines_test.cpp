// Several drivers at one TCP port, with real sockets on loopback.
#include <boost/asio/read.hpp>

#include "emulator/clock/clock.h"
#include "emulator/transport/driver_lines.h"
#include "emulator/transport/tcp.h"
#include "tests/emulator/transport/socket_fixture.h"

namespace echoloop::test {
namespace {

using Socket = asio::ip::tcp::socket;
using Slow = DriverLines::Slow;

class DriverLinesTest : public SocketTest {
  protected:
    static constexpr std::size_t any_number = 1'000'000;
    std::unique_ptr<DriverLines> listen(std::size_t drivers, Slow slow = Slow::loses,
                                        std::size_t most_messages = any_number) {
        const auto door = std::make_shared<TcpDoor>(io_, Address{loopback, 0});
        std::vector<std::unique_ptr<Transport>> lines;
        for (std::size_t i = 0; i < drivers; ++i) lines.push_back(std::make_unique<TcpListener>(door));
        auto port = std::make_unique<DriverLines>(clock_, std::move(lines), slow, most_messages);
        start(*port);
        return port;
    }
    Socket connect(const Transport& port) {
        Socket driver(io_);
        peer_ = {};
        driver.connect({asio::ip::address_v4(loopback), port_of(port)});
        EXPECT_TRUE(run_until([&] { return peer_.port == driver.local_endpoint().port(); }));
        return driver;
    }
    /// 20 MiB; the system takes some of it.
    void write_more_than_it_reads(DriverLines& port) {
        for (std::uint8_t n = 0; n < 20; ++n) write(port, Bytes(1 << 20, n));
    }
    static Address address(const Socket& driver) { return to_address(driver.local_endpoint()); }
    /// The next bytes, as many as `expected` has.
    bool hears(Socket& driver, const Bytes& expected) {
        Bytes heard(expected.size());
        std::size_t got = 0;
        driver.non_blocking(true);
        run_until([&] {
            error_code ec;
            got += driver.read_some(asio::buffer(heard.data() + got, heard.size() - got), ec);
            return got == heard.size();
        });
        return heard == expected;
    }
    RealClock clock_{io_};
};

TEST_F(DriverLinesTest, AllHearWhatIsForAllAndOneWhatIsForIt) {
    const auto port = listen(3);
    Socket one = connect(*port), other = connect(*port);
    write(*port, {1, 2});
    write(*port, {3}, address(other));
    write(*port, {4}, address(one));
    write(*port, {5}, {loopback, 1});
    write(*port, {6});
    EXPECT_TRUE(hears(one, {1, 2, 4, 6}));
    EXPECT_TRUE(hears(other, {1, 2, 3, 6}));
    EXPECT_EQ(port->bytes_out(), 8U);
}

TEST_F(DriverLinesTest, WhoSpeaksIsTold) {
    const auto port = listen(3);
    Socket one = connect(*port), other = connect(*port);
    for (Socket* driver : {&other, &one}) {
        heard_.clear();
        driver->send(asio::buffer("x", 1));
        ASSERT_TRUE(run_until([&] { return !heard_.empty(); }));
        EXPECT_EQ(from_, address(*driver));
    }
    EXPECT_EQ(reconnected_, 0) << "nobody has taken another's place";
}

TEST_F(DriverLinesTest, OneLeavesAndTheOtherGoesOnAndAThirdTakesThePlace) {
    const auto port = listen(2);
    Socket one = connect(*port), other = connect(*port), refused(io_);
    refused.connect({asio::ip::address_v4(loopback), port_of(*port)});
    error_code ec;
    refused.non_blocking(true);
    char c;
    run_until([&] {
        refused.receive(asio::buffer(&c, 1), 0, ec);
        return ec == asio::error::eof;
    });
    EXPECT_EQ(ec, asio::error::eof) << "all places are taken";
    one.close();
    ASSERT_TRUE(run_until([&] { return gone_ == 1; }));
    write(*port, {7});
    Socket third = connect(*port);
    write(*port, {8});
    EXPECT_TRUE(hears(other, {7, 8}));
    EXPECT_TRUE(hears(third, {8}));
}

TEST_F(DriverLinesTest, OneThatDoesNotReadMissesWholeMessagesAndNobodyElseDoes) {
    const auto port = listen(2);
    Socket slow = connect(*port), fast = connect(*port);
    const auto begin = std::chrono::steady_clock::now();
    for (std::uint8_t n = 0; n < 60; ++n) {
        write(*port, Bytes(1 << 20, n));
        ASSERT_TRUE(hears(fast, Bytes(1 << 20, n))) << static_cast<int>(n);
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 20s) << "without waiting 2 s for each";
    EXPECT_GT(port->bytes_lost(), 30U << 20) << "not kept for ever";
    const std::uint64_t lost = port->bytes_lost();
    std::size_t whole = 0;
    Bytes heard(1 << 20);
    for (std::uint8_t last = 0; whole < 60 - (lost >> 20); ++whole) {
        std::size_t got = 0;
        slow.non_blocking(true);
        ASSERT_TRUE(run_until([&] {
            error_code ec;
            got += slow.read_some(asio::buffer(heard.data() + got, heard.size() - got), ec);
            return got == heard.size();
        }));
        ASSERT_EQ(heard, Bytes(1 << 20, heard[0])) << "no half messages";
        ASSERT_GE(heard[0], last) << "in their order";
        last = heard[0];
    }
    EXPECT_GT(whole, 15U);
}

TEST_F(DriverLinesTest, OneThatDoesNotReadHoldsAllUpWhereThatIsAsked) {
    const auto port = listen(2, Slow::holds_up);
    Socket slow = connect(*port), fast = connect(*port);
    bool done = false;
    const Bytes message(32 << 20, 9);
    asio::co_spawn(
        io_, [&]() -> Task<void> { co_await port->write(message, {}); },
        [&done](std::exception_ptr) { done = true; });
    EXPECT_TRUE(hears(fast, message));
    EXPECT_FALSE(done);
    EXPECT_TRUE(hears(slow, message));
    EXPECT_TRUE(run_until([&] { return done; }));
    EXPECT_EQ(port->bytes_lost(), 0U);
}

TEST_F(DriverLinesTest, AHeldUpWriteEndsWithItsDriver) {
    const auto port = listen(2, Slow::holds_up);
    Socket slow = connect(*port), fast = connect(*port);
    bool done = false;
    const Bytes message(32 << 20, 9);
    asio::co_spawn(
        io_, [&]() -> Task<void> { co_await port->write(message, {}); },
        [&done](std::exception_ptr) { done = true; });
    EXPECT_TRUE(hears(fast, message));
    slow.close();
    EXPECT_TRUE(run_until([&] { return done && gone_ == 1; }));
    write(*port, {1});
    EXPECT_TRUE(hears(fast, {1}));
}

TEST_F(DriverLinesTest, HangsUpOnOneBehindItsLastByte) {
    const auto port = listen(2);
    Socket one = connect(*port), other = connect(*port);
    const Bytes answer(100'000, 7);
    write(*port, answer, address(one));
    port->hang_up(address(one));
    EXPECT_TRUE(hears(one, answer));
    EXPECT_TRUE(run_until([&] { return gone_ == 1; }));
    error_code ec;
    char c;
    one.non_blocking(false);
    one.receive(asio::buffer(&c, 1), 0, ec);
    EXPECT_EQ(ec, asio::error::eof);
    write(*port, {1});
    EXPECT_TRUE(hears(other, {1}));
}

TEST_F(DriverLinesTest, OnlyAFewMessagesWaitForOneThatDoesNotReadWhereThatIsAsked) {
    const auto port = listen(1, Slow::loses, 2);
    Socket slow = connect(*port);
    const auto begin = std::chrono::steady_clock::now();
    write_more_than_it_reads(*port);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 1500ms) << "nothing is held up";
    const std::uint64_t dropped = port->messages_dropped();
    EXPECT_GE(dropped, 8U);
    EXPECT_EQ(port->bytes_lost(), dropped << 20) << "whole ones";
    Bytes last;
    for (std::uint64_t n = 0; n < 20 - dropped; ++n) {
        Bytes heard(1 << 20);
        std::size_t got = 0;
        slow.non_blocking(true);
        ASSERT_TRUE(run_until([&] {
            error_code ec;
            got += slow.read_some(asio::buffer(heard.data() + got, heard.size() - got), ec);
            return got == heard.size();
        }));
        ASSERT_EQ(heard, Bytes(1 << 20, heard[0])) << "no half messages";
        last = heard;
    }
    write(*port, {1, 2, 3});
    EXPECT_TRUE(hears(slow, {1, 2, 3})) << "and behind them what is new";
}

TEST_F(DriverLinesTest, HangsUpOnOneThatDoesNotReadAsWell) {
    const auto port = listen(1, Slow::loses, 2);
    Socket slow = connect(*port);
    write_more_than_it_reads(*port);
    port->hang_up({});
    ASSERT_TRUE(run_until([&] { return gone_ == 1; }));
    Socket next = connect(*port);
    write(*port, {1, 2, 3});
    EXPECT_TRUE(hears(next, {1, 2, 3}));
}

TEST_F(DriverLinesTest, APulledCableEndsAllAndPutBackTheyComeAgain) {
    const auto door = std::make_shared<TcpDoor>(io_, Address{loopback, 0});
    auto first = std::make_unique<TcpListener>(door), second = std::make_unique<TcpListener>(door);
    TcpListener &a = *first, &b = *second;
    std::vector<std::unique_ptr<Transport>> lines;
    lines.push_back(std::move(first));
    lines.push_back(std::move(second));
    DriverLines port(clock_, std::move(lines), Slow::loses);
    start(port);
    const std::uint16_t number = port_of(port);
    const Socket one = connect(port), other = connect(port);
    for (TcpListener* line : {&a, &b}) line->unplug();
    EXPECT_TRUE(run_until([&] { return gone_ == 2; }));
    Socket third(io_);
    error_code ec;
    third.connect({asio::ip::address_v4(loopback), number}, ec);
    EXPECT_EQ(ec, asio::error::connection_refused);
    for (TcpListener* line : {&a, &b}) line->plug();
    Socket one_again = connect(port), other_again = connect(port);
    write(port, {1});
    EXPECT_TRUE(hears(one_again, {1}));
    EXPECT_TRUE(hears(other_again, {1}));
}

}  // namespace
}  // namespace echoloop::test
