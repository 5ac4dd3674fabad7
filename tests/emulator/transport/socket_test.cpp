// Real sockets on loopback: UDP that survives refusals, TCP that serves one driver after the other.
#include <gtest/gtest.h>

#include <boost/asio/read.hpp>

#include "emulator/contract/error.h"
#include "emulator/transport/tcp.h"
#include "emulator/transport/udp.h"
#include "tests/emulator/transport/socket_fixture.h"

namespace echoloop::test {
namespace {

TEST_F(SocketTest, UdpAnswersWhoeverSpokeAndSurvivesRefusals) {
    Udp device(io_, {loopback, 0}, false, Peers(loopback, {}));
    start(device);
    asio::ip::udp::socket driver(io_, {asio::ip::address_v4(loopback), 0});
    const asio::ip::udp::endpoint there(asio::ip::address_v4(loopback), port_of(device));
    write(device, {9}, {loopback, 1});  // nobody listens there: the refusal must not end the reading
    driver.send_to(asio::buffer("ab", 2), there);
    driver.send_to(asio::buffer("", 0), there);
    ASSERT_TRUE(run_until([&] { return heard_.size() == 2; }));
    EXPECT_EQ(heard_[0], (Bytes{'a', 'b'}));
    EXPECT_TRUE(heard_[1].empty()) << "datagrams of no bytes are legal";
    EXPECT_EQ(from_.port, driver.local_endpoint().port());
    write(device, {1, 2, 3});
    std::array<std::uint8_t, 16> buffer;
    EXPECT_EQ(driver.receive(asio::buffer(buffer)), 3u);
}

TEST_F(SocketTest, UdpOnLoopbackSendsToLoopbackOnly) {
    Udp device(io_, {loopback, 0}, false, Peers(loopback, {}));
    start(device);
    write(device, {1, 2, 3}, {0x08080808, 53});
    EXPECT_EQ(device.bytes_out(), 0U);
    EXPECT_EQ(device.targets_refused(), 1U);
    write(device, {1, 2}, {0x7FFFFFFF, 4000});
    EXPECT_EQ(device.bytes_out(), 2U);
}

TEST_F(SocketTest, PortInUseIsAStartErrorWithARemedy) {
    Udp first(io_, {loopback, 0}, false, Peers(loopback, {}));
    try {
        Udp second(io_, {loopback, port_of(first)}, false, Peers(loopback, {}));
        FAIL();
    } catch (const StartError& error) {
        EXPECT_EQ(error.exit(), Exit::unavailable);
        EXPECT_NE(std::string(error.what()).find("already in use"), std::string::npos);
    }
    TcpListener listener(io_, {loopback, 0});
    EXPECT_THROW(TcpListener(io_, {loopback, port_of(listener)}), StartError);
    EXPECT_THROW(Udp(io_, {0x08080808, 4000}, false, Peers(loopback, {})), StartError)
        << "not an address of this machine";
}

TEST_F(SocketTest, SharedPortsHearTheLoopbackBroadcast) {
    Udp one(io_, {0x7FFFFFFF, 0}, true, Peers(loopback, {}));
    const std::uint16_t port = port_of(one);
    Udp two(io_, {0x7FFFFFFF, port}, true, Peers(loopback, {}));
    start(one);
    start(two);
    asio::ip::udp::socket host(io_, {asio::ip::address_v4(loopback), 0});
    host.set_option(asio::socket_base::broadcast(true));
    host.send_to(asio::buffer("R2DD", 4), {asio::ip::address_v4(0x7FFFFFFFu), port});
    EXPECT_TRUE(run_until([&] { return heard_.size() == 2; })) << "both hear it";
}

TEST_F(SocketTest, TcpTellsWhoCameAndWhenTheyLeft) {
    TcpListener device(io_, {loopback, 0});
    start(device);
    const asio::ip::tcp::endpoint there(asio::ip::address_v4(loopback), port_of(device));
    asio::ip::tcp::socket driver(io_);
    driver.connect(there);
    ASSERT_TRUE(run_until([&] { return peer_.port != 0; }));
    EXPECT_EQ(peer_, (Address{loopback, driver.local_endpoint().port()}));
    driver.close();
    EXPECT_TRUE(run_until([&] { return gone_ == 1; }));
}

TEST_F(SocketTest, TcpHangsUpBehindTheLastByte) {
    TcpListener device(io_, {loopback, 0});
    start(device);
    const asio::ip::tcp::endpoint there(asio::ip::address_v4(loopback), port_of(device));
    asio::ip::tcp::socket driver(io_);
    driver.connect(there);
    ASSERT_TRUE(run_until([&] { return reconnected_ == 1; }));
    const Bytes answer(100'000, 7);
    write(device, answer);
    device.hang_up({});
    Bytes heard(answer.size());
    EXPECT_EQ(asio::read(driver, asio::buffer(heard)), answer.size());
    error_code ec;
    driver.receive(asio::buffer(heard), 0, ec);
    EXPECT_EQ(ec, asio::error::eof);
    EXPECT_TRUE(run_until([&] { return gone_ == 1; }));
}

TEST_F(SocketTest, TcpServesOneDriverAtATimeAndTheNextAfterIt) {
    TcpListener device(io_, {loopback, 0});
    start(device);
    const asio::ip::tcp::endpoint there(asio::ip::address_v4(loopback), port_of(device));
    asio::ip::tcp::socket first(io_), second(io_), third(io_);
    first.connect(there);
    ASSERT_TRUE(run_until([&] { return reconnected_ == 1; }));
    second.connect(there);
    first.send(asio::buffer("x", 1));
    ASSERT_TRUE(run_until([&] { return heard_.size() == 1; }));
    char c;
    error_code ec;
    second.receive(asio::buffer(&c, 1), 0, ec);
    EXPECT_EQ(ec, asio::error::eof) << "the second is turned away";
    write(device, {7});
    EXPECT_EQ(first.receive(asio::buffer(&c, 1)), 1u);
    first.close();
    // The listener may not have seen the end of the first yet; a driver tries again just so.
    run_until([&] {
        third = asio::ip::tcp::socket(io_);
        third.connect(there, ec);
        io_.restart();
        io_.run_for(5ms);
        return reconnected_ >= 2;
    });
    EXPECT_GE(reconnected_, 2);
}

TEST_F(SocketTest, TcpClientFindsADriverThatComesLater) {
    asio::ip::tcp::acceptor driver(io_, {asio::ip::address_v4(loopback), 0});
    TcpClient device(io_, "127.0.0.1", driver.local_endpoint().port());
    start(device);
    asio::ip::tcp::socket peer(io_);
    bool accepted = false;
    driver.async_accept(peer, [&](error_code) { accepted = true; });
    ASSERT_TRUE(run_until([&] { return accepted && reconnected_ == 1; }));
    write(device, {5});
    char c;
    EXPECT_EQ(peer.receive(asio::buffer(&c, 1)), 1u);
    EXPECT_EQ(c, 5);
}

}  // namespace
}  // namespace echoloop::test
