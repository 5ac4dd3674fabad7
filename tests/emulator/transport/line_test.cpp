// Pace, wrong rates and USB bursts of a serial line, around a line that only remembers.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "emulator/transport/baud_check.h"
#include "emulator/transport/paced.h"
#include "emulator/transport/usb_adapter.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;

/// Takes everything at once and remembers it.
class MemoryLine final : public Transport {
  public:
    void start(Events events) override { events_ = std::move(events); }
    Task<void> write(ByteView bytes, Address) override {
        writes.emplace_back(bytes.begin(), bytes.end());
        if (on_write) on_write();
        co_return;
    }
    void speak_at(double rate) override { asked.push_back(rate); }
    void cut_off() override { ++cuts; }
    void settle() override { ++settled; }
    void close() override {}
    std::string describe() const override { return "memory"; }
    uart::Receiver far_end() const override { return driver; }
    std::uint64_t bytes_in() const override { return 0; }
    std::uint64_t bytes_out() const override { return 0; }
    void hear(const Bytes& bytes) { events_.received(bytes, {}); }
    void reconnect() { events_.reconnected(); }
    Bytes all() const {
        Bytes bytes;
        for (const Bytes& part : writes) bytes.insert(bytes.end(), part.begin(), part.end());
        return bytes;
    }

    std::function<void()> on_write;
    uart::Receiver driver;
    std::vector<Bytes> writes;
    std::vector<double> asked;
    int cuts = 0, settled = 0;

  private:
    Events events_;
};

class LineTest : public testing::Test {
  protected:
    LineTest() : line_(std::make_unique<MemoryLine>()), memory_(*line_) {}

    /// s of run time that the write takes.
    double write(Transport& transport, const Bytes& bytes) {
        bool done = false;
        const Time begin = clock_.now();
        asio::co_spawn(
            io_, [&]() -> Task<void> { co_await transport.write(bytes, {}); },
            [&done](std::exception_ptr) { done = true; });
        run_until([&] { return done; });
        return to_seconds(clock_.now() - begin);
    }

    template <class Done>
    void run_until(Done done) {
        const auto end = std::chrono::steady_clock::now() + 3s;
        io_.restart();
        while (!done() && std::chrono::steady_clock::now() < end) {
            io_.run_one_for(1s);
            io_.restart();
        }
    }

    void start(Transport& transport) {
        transport.start(
            {[this](ByteView bytes, Address) { heard_.assign(bytes.begin(), bytes.end()); }, [] {}});
    }

    asio::io_context io_;
    RealClock clock_{io_};
    std::unique_ptr<MemoryLine> line_;
    MemoryLine& memory_;
    Bytes heard_;
};

TEST_F(LineTest, AutomaticBaudIsAsSlowAsTheDriverHasSetIt) {
    Paced paced(clock_, std::move(line_), 0, Paced::OtherRate::followed);
    EXPECT_LT(write(paced, Bytes(4000)), 0.4) << "nobody has set a rate";
    EXPECT_EQ(memory_.writes.size(), 1u);
    memory_.driver = {921600};
    const double fast = write(paced, Bytes(4000));
    EXPECT_GE(fast, 40000 / 921600.0);
    EXPECT_LT(fast, 40000 / 115200.0) << "far from the next rate, however busy the machine";
    memory_.driver = {115200};
    EXPECT_GE(write(paced, Bytes(600)), 6000 / 115200.0);
}

TEST_F(LineTest, BytesAreHandedOverEveryTwoMillisecondsAndNeverBeforeTheyHaveArrived) {
    std::vector<double> handed_over;  // s of run time
    memory_.on_write = [&] { handed_over.push_back(to_seconds(clock_.now())); };
    Paced paced(clock_, std::move(line_), 115200);
    const double begin = to_seconds(clock_.now());
    write(paced, Bytes(400));
    EXPECT_GE(memory_.writes.size(), 17u) << "35 ms of bytes";
    std::size_t arrived = 0;
    for (std::size_t i = 0; i < memory_.writes.size(); ++i) {
        arrived += memory_.writes[i].size();
        EXPECT_GE(handed_over[i] - begin, static_cast<double>(arrived) * 10 / 115200 - 1e-6);
        if (i > 0 && arrived < 400) {
            EXPECT_NEAR(static_cast<double>(memory_.writes[i].size()), 23.04, 1) << "bytes in 2 ms";
        }
    }
    EXPECT_EQ(arrived, 400u);
}

TEST_F(LineTest, AnOwnRateHoldsUnlessTheDriversIsNearIt) {
    Paced paced(clock_, std::move(line_), 19200);
    EXPECT_GE(write(paced, Bytes(100)), 1000 / 19200.0);
    memory_.driver = {19000};
    EXPECT_GE(write(paced, Bytes(100)), 1000 / 19000.0);
    memory_.driver = {4000000};
    EXPECT_GE(write(paced, Bytes(100)), 1000 / 19200.0) << "the device cannot talk faster";
}

TEST_F(LineTest, ADeviceMaySpeakAtAnotherRateForAMessage) {
    Paced paced(clock_, std::move(line_), 921600, Paced::OtherRate::garbage);
    paced.speak_at(9600);
    EXPECT_EQ(memory_.asked, std::vector<double>{9600}) << "a real port has to change as well";
    EXPECT_GE(write(paced, Bytes(48)), 480 / 9600.0);
    memory_.driver = {9600};
    EXPECT_GE(write(paced, Bytes(48)), 480 / 9600.0);
    memory_.driver = {921600};
    EXPECT_LT(write(paced, Bytes(48)), 480 / 9600.0) << "garbage is somebody else's";
    memory_.driver = {};
    paced.speak_at(0);
    EXPECT_LT(write(paced, Bytes(480)), 4800 / 38400.0) << "at its own again";
}

TEST_F(LineTest, WhoHasNotFollowedToTheAskedRateHearsGarbageAtItsPace) {
    BaudCheck check(clock_, std::move(line_), 115200, "sonar");
    start(check);
    memory_.driver = {115200};
    check.speak_at(57600);
    EXPECT_GE(write(check, Bytes(288, 0x55)), 2880 / 57600.0);
    const Bytes garbage = memory_.all();
    EXPECT_EQ(garbage.at(0), 0x66) << "from uart_test";
    EXPECT_EQ(garbage, uart::as_heard(Bytes(288, 0x55), 57600, {115200}));
    memory_.writes.clear();
    memory_.driver = {57600};
    write(check, {1, 2, 3});
    EXPECT_EQ(memory_.all(), (Bytes{1, 2, 3}));
    memory_.hear({0x55});
    EXPECT_EQ(heard_, (Bytes{0x55})) << "it may have gone there after it had spoken";
    memory_.reconnect();
    memory_.hear({0x55});
    EXPECT_NE(heard_, (Bytes{0x55})) << "another driver, that has asked for nothing";
    EXPECT_EQ(memory_.asked, std::vector<double>{57600});
}

TEST_F(LineTest, WordsOfADriverThatHasChangedItsRateSinceAreStillUnderstood) {
    BaudCheck check(clock_, std::move(line_), 115200, "sonar");
    start(check);
    memory_.driver = {115200};
    memory_.hear({1});
    memory_.driver = {9600};  // it has asked, and waits for an answer at 9600
    memory_.hear({2});
    EXPECT_EQ(heard_, (Bytes{2}));
    memory_.hear({3});
    EXPECT_NE(heard_, (Bytes{3})) << "said at 9600";
    memory_.driver = {115200};
    memory_.hear({4});
    EXPECT_EQ(heard_, (Bytes{4}));
}

TEST_F(LineTest, WithoutPowerTheRestOfAMessageNeverLeaves) {
    auto paced = std::make_unique<Paced>(clock_, std::move(line_), 9600, Paced::OtherRate::garbage);
    BaudCheck check(clock_, std::move(paced), 9600, "sonar");
    for (const double driver : {9600.0, 19200.0}) {  // bytes, garbage
        memory_.driver = {driver};
        memory_.writes.clear();
        asio::co_spawn(
            io_, [&]() -> Task<void> { co_await check.write(Bytes(9600, 0x55), {}); },
            [](std::exception_ptr) {});
        asio::post(io_, [&] { check.cut_off(); });
        const Time begin = clock_.now();
        io_.restart();
        io_.run();
        EXPECT_LT(clock_.now() - begin, 5s) << driver;
        EXPECT_LT(memory_.all().size(), 4000u) << driver;
    }
    EXPECT_EQ(memory_.cuts, 2);
    memory_.driver = {9600};
    memory_.writes.clear();
    EXPECT_LT(write(check, {1, 2, 3}), 2) << "the next message begins anew";
    EXPECT_EQ(memory_.all(), (Bytes{1, 2, 3}));
}

TEST_F(LineTest, ADecoratorLetsTheLineSettle) {
    BaudCheck check(clock_, std::make_unique<Paced>(clock_, std::move(line_), 9600), 9600, "sonar");
    check.settle();
    EXPECT_EQ(memory_.settled, 1);
}

TEST_F(LineTest, OneWhoListensAtAnotherRateHearsGarbageInBothDirections) {
    BaudCheck check(clock_, std::move(line_), 57600, "sonar");
    start(check);
    memory_.driver = {115200};
    write(check, {0x55});
    EXPECT_EQ(memory_.all(), (Bytes{0x66, 0xE6})) << "worked out in uart_test";
    memory_.driver = {19200};
    memory_.hear({0x00});  // low for nine bits: a start bit and 26 zeros to a device thrice as fast
    EXPECT_EQ(heard_, (Bytes{0x00})) << "a break";
}

TEST_F(LineTest, GarbageTakesTheTimeOfTheBytesThatItWas) {
    BaudCheck check(clock_, std::move(line_), 9600, "sonar");
    memory_.driver = {115200};
    EXPECT_GE(write(check, Bytes(48, 0x55)), 480 / 9600.0);
    EXPECT_GT(memory_.writes.size(), 20u) << "all along";
}

TEST_F(LineTest, NothingHappensToADriverThatAgreesOrHasSetNothing) {
    BaudCheck check(clock_, std::move(line_), 115200, "sonar");
    start(check);
    for (const double rate : {0.0, 115200.0, 113000.0}) {
        memory_.writes.clear();
        memory_.driver = {rate};
        write(check, {1, 2, 3});
        EXPECT_EQ(memory_.all(), (Bytes{1, 2, 3})) << rate;
        memory_.hear({4, 5});
        EXPECT_EQ(heard_, (Bytes{4, 5})) << rate;
    }
}

TEST_F(LineTest, AUsbAdapterHandsOverFullPacketsAndTheRestWhenItsTimerRings) {
    UsbAdapter usb(clock_, std::move(line_), 40ms);
    start(usb);
    const Time begin = clock_.now();
    write(usb, Bytes(130, 7));
    ASSERT_EQ(memory_.writes.size(), 2u);
    EXPECT_EQ(memory_.writes[0].size(), 62u);
    EXPECT_EQ(memory_.writes[1].size(), 62u);
    run_until([&] { return memory_.writes.size() == 3; });
    EXPECT_GE(clock_.now() - begin, 39ms);
    EXPECT_EQ(memory_.all(), Bytes(130, 7));
    usb.close();
}

}  // namespace
}  // namespace echoloop::test
