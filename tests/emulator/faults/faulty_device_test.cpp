// A device that loses its power, whose motor is stuck, whose image is frozen: what it asks of the water, and
// what it is made to hear.
#include "emulator/faults/faulty_device.h"

#include <gtest/gtest.h>

namespace echoloop {
namespace {

using namespace std::chrono_literals;

/// Turns by a step with each ping and keeps what it hears.
class Turner : public Device {
  public:
    struct Life {
        int made = 0;
        std::vector<float> heard{};
        double rate = 0;
    };
    explicit Turner(Life& life) : life_(life) { ++life_.made; }
    std::vector<Port> ports() const override { return {{"line", Port::Kind::stream, {}, false}}; }
    Actions started(Time now) override { return woken(now); }
    Actions received(const Received& data, Time now) override {
        ++received_;
        return {{{0, {data.bytes.begin(), data.bytes.end()}, {}, now}}, {}, {}};
    }
    Actions heard(const Echogram& echogram, Time) override {
        life_.heard.push_back(echogram.values.front());
        return {};
    }
    Actions woken(Time now) override {
        Shot shot;
        shot.pan = pan_;
        pan_ += 0.1;
        return {{}, Ping{shot, now}, {}};
    }
    void reconnected(std::size_t) override {}
    void line_rate(std::size_t, double rate) override { life_.rate = rate; }
    DeviceCounters counters() const override { return {received_, 0, 0, 0}; }

  private:
    Life& life_;
    double pan_ = 0;
    std::uint64_t received_ = 0;
};

class FaultyDeviceTest : public testing::Test {
  protected:
    void ask(FaultKind kind, Time from, Time length) {
        Fault fault;
        fault.device = "head";
        fault.kind = kind;
        fault.from = from;
        fault.length = length;
        faults_.add(fault);
    }
    double pan_at(Time now) { return device_.woken(now).ping.value().shot.pan; }
    void hear(float level, Time now, std::size_t bins = 4) {
        Echogram echogram;
        echogram.shot.bearings = {0};
        echogram.shot.bins = bins;
        echogram.values.assign(bins, level);
        device_.about_to_hear(now);
        device_.heard(echogram, now);
    }
    std::uint64_t made(FaultKind kind) const {
        const auto& counts = faults_.labels().counts();
        return counts.contains("head") ? counts.at("head")[static_cast<std::size_t>(kind)] : 0;
    }

    Turner::Life life_;
    Faults faults_{1, "", nullptr};
    FaultyDevice device_{[this] { return std::make_unique<Turner>(life_); }, faults_.of("head")};
};

TEST_F(FaultyDeviceTest, AStuckMotorStaysWhileTheDeviceCountsOn) {
    ask(FaultKind::stuck_motor, 2s, 2s);
    EXPECT_NEAR(pan_at(0s), 0, 1e-9);
    EXPECT_NEAR(pan_at(1s), 0.1, 1e-9);
    EXPECT_NEAR(pan_at(2s), 0.1, 1e-9) << "where it was last";
    EXPECT_NEAR(pan_at(3s), 0.1, 1e-9);
    EXPECT_NEAR(pan_at(4s), 0.4, 1e-9) << "the device has counted on";
    EXPECT_EQ(made(FaultKind::stuck_motor), 2u);
}

TEST_F(FaultyDeviceTest, AFrozenImageIsTheLastOneAgain) {
    ask(FaultKind::frozen_image, 2s, 2s);
    for (int i = 0; i < 6; ++i) hear(static_cast<float>(i), i * 1s);
    EXPECT_EQ(life_.heard, (std::vector<float>{0, 1, 1, 1, 4, 5}));
    EXPECT_EQ(made(FaultKind::frozen_image), 2u);
}

TEST_F(FaultyDeviceTest, AFrozenImageFitsOtherSettings) {
    ask(FaultKind::frozen_image, 1s, 2s);
    hear(7, 0s, 4);
    hear(8, 1s, 9);
    hear(9, 2s, 2);
    EXPECT_EQ(life_.heard, (std::vector<float>{7, 7, 7}));
}

TEST_F(FaultyDeviceTest, WithoutPowerItIsDeafAndThenItIsAnotherOne) {
    pan_at(0s);
    pan_at(0s);
    device_.line_rate(0, 57600);
    EXPECT_EQ(device_.received({0, {}, {}}, 0s).send.size(), 1u);
    device_.cut_power();
    EXPECT_TRUE(device_.received({0, {}, {}}, 1s).send.empty());
    EXPECT_FALSE(device_.woken(1s).ping);
    EXPECT_EQ(device_.counters().messages, 1u) << "counters go on";
    life_.rate = 0;
    EXPECT_NEAR(device_.started(2s).ping.value().shot.pan, 0, 1e-9) << "it begins anew";
    EXPECT_EQ(life_.made, 2);
    EXPECT_EQ(life_.rate, 57600) << "the line is as fast as before";
    device_.received({0, {}, {}}, 2s);
    EXPECT_EQ(device_.counters().messages, 2u);
}

}  // namespace
}  // namespace echoloop
