// The datagrams of the sensors around a Kongsberg multibeam. Offsets are those of the specification notes on
// survey records; sizes and rates are those of real files.
#include <cmath>

#include "tests/emulator/devices/kmall_bench.h"

namespace echoloop::test {
namespace {

constexpr std::size_t first_sample = 32;
constexpr std::size_t sample_size = 132;
template <class T>
T sample(const Bytes& motion, std::size_t n, std::size_t offset) {
    return at<T>(motion, first_sample + n * sample_size + offset);
}

/// A head that looks down, z to the bow, on a vessel that heads by `yaw` east of north and rolls to
/// starboard.
Pose looking_down(double roll, double pitch, double heading, Vec3 position) {
    const Quat vessel = from_rpy(roll, -pitch, std::numbers::pi / 2 - heading);
    return {position, vessel * from_rpy(0, std::numbers::pi / 2, 0)};
}

TEST(KmallSensors, TellTheMotionOfEachHundredthOfASecond) {
    Bench bench = sounder({{"pinging", false}, {"sensor_datagrams", true}});
    const double degree = deg_to_rad(1);
    bench.where = [degree](Time time) {
        const double t = to_seconds(time);
        Located where{
            time, looking_down(5 * degree * std::sin(t), 2 * degree, 30 * degree, {3 * t, 4 * t, -10}), {}};
        where.motion.velocity = {3, 4, -0.5};
        return where;
    };
    bench.run_to(1s + 21ms);
    const auto motions = of_type(bench.sent(), "#SKM");
    ASSERT_EQ(motions.size(), 1U);
    const Bytes& m = motions.front().bytes;
    ASSERT_EQ(m.size(), 13500U);  // as every one of an EM 2042
    EXPECT_EQ(u16(m, 20 + 6), 102U);
    EXPECT_EQ(u16(m, 20 + 8), 132U);
    for (const std::size_t n : {0UL, 50UL, 101UL}) {
        const double t = 0.01 * static_cast<double>(n);
        EXPECT_EQ(std::string(m.begin() + static_cast<std::ptrdiff_t>(first_sample + n * 132),
                              m.begin() + static_cast<std::ptrdiff_t>(first_sample + n * 132 + 4)),
                  "#KMB");
        EXPECT_NEAR(sample<std::uint32_t>(m, n, 12), 1e9 * (t - std::floor(t)), 2) << n;
        EXPECT_NEAR(sample<float>(m, n, 40), 5 * std::sin(t), 1e-4) << n;
        EXPECT_NEAR(sample<float>(m, n, 44), 2, 1e-4);
        EXPECT_NEAR(sample<float>(m, n, 48), 30, 1e-4);
        EXPECT_NEAR(sample<float>(m, n, 68), 4, 1e-6);    // north
        EXPECT_NEAR(sample<float>(m, n, 72), 3, 1e-6);    // east
        EXPECT_NEAR(sample<float>(m, n, 76), 0.5, 1e-6);  // down
        EXPECT_NEAR(sample<float>(m, n, 36), -10, 1e-5);  // height
    }
    // One metre to the north is 9.04e-6 deg at the equator.
    EXPECT_NEAR(sample<double>(m, 100, 20) - sample<double>(m, 0, 20), 4 / 110574.3, 1e-9);
}

TEST(KmallSensors, TellRatesOfTheAngles) {
    Bench bench = sounder({{"pinging", false}, {"sensor_datagrams", true}});
    bench.where = [](Time time) {
        Located where{time, looking_down(0, 0, 0, {}), {}};
        where.motion.turning = {-0.3, 0.2, 0.1};  // about the head's axes: down, port, ahead
        return where;
    };
    bench.run_to(1s + 21ms);
    const Bytes m = of_type(bench.sent(), "#SKM").at(0).bytes;
    EXPECT_NEAR(sample<float>(m, 7, 56), rad_to_deg(0.1), 1e-4);
    EXPECT_NEAR(sample<float>(m, 7, 60), rad_to_deg(-0.2), 1e-4);
    EXPECT_NEAR(sample<float>(m, 7, 64), rad_to_deg(-0.3), 1e-4);
}

TEST(KmallSensors, HeaveIsWhatIsQuickerThanTenSeconds) {
    Bench bench = sounder({{"pinging", false}, {"sensor_datagrams", true}});
    bench.where = [](Time time) {
        const double t = to_seconds(time);
        return Located{time, looking_down(0, 0, 0, {0, 0, -20 + 0.5 * std::sin(2 * t)}), {}};
    };
    bench.run_to(60s);
    const Bytes m = of_type(bench.sent(), "#SKM").back().bytes;
    float most = 0;
    for (std::size_t n = 0; n < 102; ++n) most = std::max(most, std::abs(sample<float>(m, n, 52)));
    EXPECT_GT(most, 0.3F);
    for (std::size_t n = 0; n < 102; ++n) {
        const double t = 1.02 * std::floor(60 / 1.02) - 1.02 + 0.01 * static_cast<double>(n);
        EXPECT_NEAR(sample<float>(m, n, 52), -0.5 * std::sin(2 * t), 0.05);  // down
    }
}

TEST(KmallSensors, TellPlaceClockErrorAndSoundSpeedTwiceASecond) {
    Bench bench =
        sounder({{"pinging", false}, {"sensor_datagrams", true}, {"latitude", 59.4}, {"longitude", 10.5}});
    bench.run_to(2s);
    const auto sent = bench.sent();
    for (const char* each : {"#SCL", "#SPO", "#CPO", "#SPE", "#SVT"})
        EXPECT_EQ(of_type(sent, each).size(), 4U) << each;
    const Bytes spo = of_type(sent, "#SPO").front().bytes;
    EXPECT_EQ(spo.size() % 2, 0U);
    EXPECT_NEAR(at<double>(spo, 40), 59.4, 1e-9);
    EXPECT_NEAR(at<double>(spo, 48), 10.5, 1e-9);
    const std::string gga(spo.begin() + 68, spo.end() - 4);
    EXPECT_EQ(gga.substr(0, 7), "$GPGGA,");
    EXPECT_NE(gga.find(",5924.0000000,N,01030.0000000,E,4,"), std::string::npos) << gga;
    const Bytes svt = of_type(sent, "#SVT").front().bytes;
    ASSERT_EQ(svt.size(), 68U);
    EXPECT_EQ(f32(svt, 48), 1500.0F);
    EXPECT_EQ(f32(svt, 52), -9999.0F);
    for (const Send& send : sent) EXPECT_EQ(send.bytes.size() % 2, 0U) << type(send);
}

TEST(KmallSensors, HeaveOfAPingComesBeforeItsWaterColumn) {
    Bench bench = sounder({{"water_column", true}, {"sensor_datagrams", true}});
    bench.run_to(1s);
    std::string order;
    for (const Send& send : bench.sent())
        if (type(send) == "#CHE" || (type(send) == "#MWC" && u16(send.bytes, 22) == 1))
            order += type(send).substr(1, 1) + type(send)[2];
    ASSERT_FALSE(order.empty());
    for (std::size_t i = 0; i + 3 < order.size(); i += 4) EXPECT_EQ(order.substr(i, 4), "CHMW");
}

TEST(KmallSensors, AreSilentIfTheOptionSaysSo) {
    Bench bench = sounder({{"pinging", false}, {"sensor_datagrams", false}});
    bench.run_to(5s);
    EXPECT_TRUE(bench.sent().empty());
}

}  // namespace
}  // namespace echoloop::test
