// A Norbit WBMS' pings: shots, timing, packets, read by the document's offsets.
#include <functional>

#include "tests/emulator/devices/norbit_bench.h"

namespace echoloop::test {
namespace {

/// The shot of the first ping after these commands.
Shot shot_after(const std::vector<std::string>& said, const Options& changes = {}) {
    Bench bench = norbit(changes);
    for (const std::string& command : said) ask(bench, command);
    ask(bench, "set_power 1");
    bench.run_to(bench.now);
    EXPECT_TRUE(bench.ping);
    return bench.ping ? bench.ping->shot : Shot{};
}

void place_echo(Bench& bench, double metres) {
    const Shot& shot = bench.ping->shot;
    bench.echo_bin = static_cast<std::size_t>((2 * metres / 1500 - shot.first_bin_time) / shot.bin_interval);
    bench.echo_power = 1e14F;
}

TEST(NorbitWbms, SettingsMakeTheShot) {
    const Shot shot = shot_after({"set_gate_mode 0", "set_range 5 30", "set_direction 10",
                                  "set_opening_angle 60", "set_tx 200 40 15 100"});
    EXPECT_EQ(shot.bearings.size(), 256U);
    EXPECT_NEAR(rad_to_deg(shot.bearings.front()), 10 - 30 * 255.0 / 256, 1e-9);
    EXPECT_NEAR(rad_to_deg(shot.bearings.back()), 10 + 30 * 255.0 / 256, 1e-9);
    EXPECT_NEAR(shot.first_bin_time, 10 / 1500.0, 1.5 / 78125);
    EXPECT_NEAR(shot.bin_interval, 1 / 78125.0, 1e-12);
    EXPECT_NEAR(static_cast<double>(shot.bins), 50 / 1500.0 * 78125, 4);
    EXPECT_EQ(shot.frequency, 200e3);
    EXPECT_EQ(shot.bandwidth, 40e3);
    EXPECT_NEAR(shot.pulse_length, 100e-6, 1e-12);
    const Shot plain = shot_after({"set_gate_mode 0", "set_range 5 30"});
    EXPECT_NEAR(shot.beam_width, 2 * plain.beam_width, 1e-12);
    EXPECT_NEAR(shot_after({"set_tx 400 80 3 500"}).source_level, plain.source_level - 13.98, 0.01);
    EXPECT_LT(shot_after({"set_tx 400 80 0 500"}).source_level, -200);
    EXPECT_NEAR(rad_to_deg(shot_after({"set_flip 0", "set_direction 20"}).bearings[128]), -20, 0.4);
    EXPECT_NEAR(shot_after({"set_mf_decimation 4", "set_gate_mode 0"}).bin_interval, 4 / 78125.0, 1e-12);
    EXPECT_EQ(shot_after({}, {{"beam_mode", std::string("512EA")}}).bearings.size(), 512U);
}

TEST(NorbitWbms, AForwardLookingSystemLightsWhatLiesAhead) {
    const Shot forward = shot_after({}, {{"system", std::string("forward-looking")}});
    EXPECT_NEAR(rad_to_deg(forward.fan_height), 20, 1e-9);
    EXPECT_LT(rad_to_deg(shot_after({}).fan_height), 2);
}

TEST(NorbitWbms, HugeWindowsStayBounded) {
    for (const char* opening : {"set_opening_angle 360", "set_opening_angle 0", "set_opening_angle 140"}) {
        const Shot shot = shot_after({"set_range 0 600", opening, "set_direction -90"});
        EXPECT_LE(shot.bins, 4097U);
        EXPECT_GE(shot.bins, 16U);
        EXPECT_LT(shot.bearings.front(), shot.bearings.back());
        EXPECT_NEAR(shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval, 0.8, 0.01);
    }
}

TEST(NorbitWbms, PingsComeAtTheRateOrAsFastAsSoundAllows) {
    Bench bench = norbit({{"power", true}});
    ask(bench, "set_gate_mode 0");
    ask(bench, "set_range 0 30");
    ask(bench, "set_rate 5");
    bench.run_to(2s);
    bench.shots.clear();
    bench.run_to(4s);
    EXPECT_EQ(bench.shots.size(), 10U);
    ask(bench, "set_rate -1");
    bench.run_to(5s);
    bench.shots.clear();
    bench.run_to(6s);
    EXPECT_NEAR(static_cast<double>(bench.shots.size()), 1 / (60 / 1500.0 + 0.010), 1);
    EXPECT_EQ(ask(bench, "set_rate 0.001"), "set_rate 0.001 # Hz, -1 automatic\r\n");
    bench.run_to(7s);
    bench.shots.clear();
    bench.run_to(900s);
    EXPECT_TRUE(bench.shots.empty()) << "the next comes after 1000 s";
    bench.run_to(1100s);
    EXPECT_EQ(bench.shots.size(), 1U);
    ask(bench, "set_rate -1");
    ask(bench, "set_trigger_mode 4");
    bench.run_to(1101s);
    bench.shots.clear();
    bench.run_to(1103s);
    EXPECT_TRUE(bench.shots.empty()) << "no trigger ever comes";
}

TEST(NorbitWbms, ARateThatIsNoneIsRefusedAndPingsGoOn) {
    Bench bench = norbit({{"power", true}});
    for (const char* command : {"set_gate_mode 0", "set_range 0 30", "set_rate 10"}) ask(bench, command);
    for (const char* rate : {"1e-12", "5e-324", "0.00099", "-1.5", "61", "nan", "inf"})
        EXPECT_EQ(ask(bench, std::string("set_rate ") + rate), "set_rate 10 # out of range, not set\r\n")
            << rate;
    bench.run_to(1s);
    bench.shots.clear();
    bench.run_to(3s);
    EXPECT_EQ(bench.shots.size(), 20U);
    for (const char* automatic : {"0", "-0.5", "-1"}) {
        EXPECT_EQ(ask(bench, std::string("set_rate ") + automatic),
                  std::string("set_rate ") + automatic + " # Hz, -1 automatic\r\n");
        bench.run_to(bench.now + 1s);
        bench.shots.clear();
        bench.run_to(bench.now + 1s);
        EXPECT_NEAR(static_cast<double>(bench.shots.size()), 1 / (2 * 30 / 1500.0 + 0.01), 2) << automatic;
    }
}

TEST(NorbitWbms, BathymetryHasTheEchoAtItsSample) {
    Bench bench = norbit({{"newer_fields", true}});
    ask(bench, "set_gate_mode 0");
    ask(bench, "set_range 1 30");
    ask(bench, "set_power 1");
    bench.run_to(bench.now);
    place_echo(bench, 9);
    const Time transmitted = bench.now;
    bench.run_to(bench.ping->due);
    EXPECT_NEAR(to_seconds(bench.now - transmitted), 2 * 30 / 1500.0 + 0.010, 1e-3);
    const auto sent = packets(bench, bathymetry);
    ASSERT_EQ(sent.size(), 1U);
    const Bytes& b = sent[0];
    EXPECT_EQ(to_hex(ByteView(b).first(4)), "efbeadde");
    EXPECT_EQ(u32(b, 4), 1U);
    EXPECT_EQ(u32(b, 8), b.size());
    EXPECT_EQ(b.size(), 112U + 20 * 256);
    EXPECT_EQ(u32(b, 12), 4U);
    EXPECT_EQ(f32(b, 24), 1500);
    EXPECT_EQ(f32(b, 28), 78125);
    EXPECT_EQ(u32(b, 36), 1U);
    EXPECT_NEAR(f64(b, 40), to_seconds(transmitted), 1e-6);
    EXPECT_EQ(u16(b, 60), 4);
    EXPECT_EQ(b[62], 2);
    EXPECT_EQ(b[63], 1);
    EXPECT_EQ(f32(b, 80), 400e3F);
    EXPECT_TRUE(std::isnan(f32(b, 96)));
    EXPECT_NEAR(f32(b, 104), deg_to_rad(140), 1e-6);
    for (std::size_t n = 0; n < 256; ++n) {
        const std::size_t at = 112 + 20 * n;
        EXPECT_NEAR(u32(b, at), 2 * 9 / 1500.0 * 78125, 1) << n;
        EXPECT_NEAR(u16(b, at + 8), 2 * 1 / 1500.0 * 78125, 1);
        EXPECT_NEAR(u16(b, at + 10), 2 * 30 / 1500.0 * 78125, 1);
        EXPECT_EQ(u16(b, at + 16), 1) << "by magnitude";
        EXPECT_EQ(b[at + 18] & 1, 1);
    }
    EXPECT_NEAR(f32(b, 112 + 20 * 128 + 12), 1e7, 1) << "intensity: uPa";
}

TEST(NorbitWbms, SilenceIsNoSounding) {
    Bench bench = norbit({{"power", true}});
    bench.run_to(1s);
    const auto sent = packets(bench, bathymetry);
    ASSERT_FALSE(sent.empty());
    for (std::size_t n = 0; n < 256; ++n) {
        EXPECT_EQ(u32(sent[0], 112 + 20 * n), 0U);
        EXPECT_EQ(sent[0][112 + 20 * n + 18], 0);
    }
}

TEST(NorbitWbms, WaterColumnGoesOutOnceSomebodyHasConnected) {
    Bench bench = norbit();
    ask(bench, "set_gate_mode 0");
    ask(bench, "set_range 0 30");
    ask(bench, "set_power 1");
    bench.run_to(1s);
    EXPECT_TRUE(packets(bench, water_column).empty());
    bench.connect(water_column, host);
    place_echo(bench, 9);
    bench.run_to(2s);
    const auto sent = packets(bench, water_column);
    ASSERT_FALSE(sent.empty());
    const Bytes& b = sent.back();
    const std::uint32_t beams = u32(b, 32), rows = u32(b, 36);
    EXPECT_EQ(u32(b, 4), 2U);
    EXPECT_EQ(beams, 128U);
    EXPECT_NEAR(rows, 256, 10);
    EXPECT_EQ(u32(b, 48), 3U);
    EXPECT_EQ(b.size(), 192U + beams * rows * 2 + beams * 4);
    EXPECT_EQ(f32(b, 72), 400);
    EXPECT_EQ(u32(b, 84), 15U);
    EXPECT_EQ(u32(b, 120), 256U);
    EXPECT_NEAR(std::remainder(78125 / f32(b, 28), 1.0), 0, 1e-5) << "a whole fraction";
    std::size_t brightest = 0;
    for (std::size_t row = 0; row < rows; ++row)
        if (u16(b, 192 + 2 * beams * row) > u16(b, 192 + 2 * beams * brightest)) brightest = row;
    const double t0 = u32(b, 52), range = (t0 + static_cast<double>(brightest)) * 1500 / (2 * f32(b, 28));
    EXPECT_NEAR(range, 9, 1500 / (2 * f32(b, 28)) / 2 + 0.01) << "the nearest row";
    EXPECT_GT(u16(b, 192 + 2 * beams * brightest), 0.4 * 32767) << "the digital gain has followed";
    EXPECT_EQ(std::fmod(f32(b, 56), 6), 0);
    EXPECT_NEAR(f32(b, 192 + beams * rows * 2), -deg_to_rad(70) * 127 / 128, 1e-5);
}

TEST(NorbitWbms, EveryPingGoesToAllAndWaterColumnsAsLongAsOneHostIsThere) {
    Bench bench = norbit({{"power", true}});
    bench.connect(water_column, host);
    bench.connect(water_column, other_host);
    bench.disconnect(water_column, host);
    bench.run_to(1s);
    std::size_t images = 0;
    for (const Send& send : bench.sent()) {
        EXPECT_EQ(send.to, Address{}) << "all who are connected";
        images += send.port == water_column;
    }
    EXPECT_GT(images, 2U);
    bench.disconnect(water_column, other_host);
    bench.run_to(2s);
    EXPECT_FALSE(packets(bench, bathymetry).empty());
    bench.run_to(3s);
    EXPECT_TRUE(packets(bench, water_column).empty());
}

/// Soundings and water columns of 10 s at 20 pings a second.
std::pair<std::size_t, std::size_t> packets_of_ten_seconds(Bench& bench) {
    bench.run_to(bench.now + 1s);
    bench.sent();
    bench.run_to(bench.now + 10s);
    std::pair<std::size_t, std::size_t> counted;
    for (const Send& send : bench.sent()) {
        counted.first += send.port == bathymetry;
        counted.second += send.port == water_column;
    }
    return counted;
}

TEST(NorbitWbms, WaterColumnsHaveARateOfTheirOwn) {
    for (const char* system : {"bathymetry", "forward-looking"}) {
        Bench bench = norbit({{"system", std::string(system)}, {"power", true}});
        bench.connect(water_column, host);
        for (const char* command : {"set_gate_mode 0", "set_range 0 10", "set_rate 20"}) ask(bench, command);
        const std::size_t soundings = system == std::string("bathymetry") ? 200 : 0;
        EXPECT_EQ(packets_of_ten_seconds(bench), std::pair(soundings, std::size_t{50})) << "by default";
        for (const auto& [rate, images] : {std::pair("12.5", 125), {"20", 200}, {"60", 200}, {"2", 20}}) {
            ask(bench, std::string("set_tp_rate ") + rate);
            const auto [points, columns] = packets_of_ten_seconds(bench);
            EXPECT_EQ(points, soundings) << rate;
            EXPECT_NEAR(static_cast<double>(columns), images, 1) << rate;
        }
        for (const char* none : {"0", "-1"}) {
            ask(bench, std::string("set_tp_rate ") + none);
            EXPECT_EQ(packets_of_ten_seconds(bench).second, 200U) << "with every ping";
        }
    }
}

TEST(NorbitWbms, ARateOfWaterColumnsThatIsNoneIsRefused) {
    Bench bench = norbit();
    EXPECT_EQ(ask(bench, "set_tp_rate"), "set_tp_rate 5 # Hz, -1 every ping\r\n");
    EXPECT_EQ(ask(bench, "set_tp_rate 2"), "set_tp_rate 2 # Hz, -1 every ping\r\n");
    for (const char* rate : {"1e-12", "61", "-1.5", "nan"})
        EXPECT_EQ(ask(bench, std::string("set_tp_rate ") + rate),
                  "set_tp_rate 2 # out of range, not set\r\n");
}

TEST(NorbitWbms, WaterColumnsAreNeverLongerThanThePayloadAllows) {
    for (const char* sample : {"u8", "s16", "f32"}) {
        Bench bench = norbit({{"beam_mode", std::string("512EA")}, {"sample", std::string(sample)}});
        bench.connect(water_column, host);
        for (const char* command : {"set_resolution 2048 512", "set_range 0 600", "set_power 1"})
            ask(bench, command);
        bench.run_to(1s);
        const auto sent = packets(bench, water_column);
        ASSERT_FALSE(sent.empty());
        EXPECT_LE(sent[0].size(), 24U + 1048576);
        EXPECT_LE(u32(sent[0], 32) * u32(sent[0], 36), 512U * 1024);
        EXPECT_GT(sent[0].size(), 300000U);
    }
}

/// The floats of the first beam in the water column of a first ping whose bins hold `power(bin)`, and t0.
std::pair<std::vector<float>, std::size_t> first_column(const std::string& range, Shot& shot,
                                                        const std::function<float(std::size_t)>& power) {
    Bench bench = norbit({{"sample", std::string("f32")}});
    bench.connect(water_column, host);
    for (const std::string& command :
         {std::string("set_gate_mode 0"), range, std::string("set_resolution 512 256")})
        ask(bench, command);
    ask(bench, "set_power 1");
    bench.run_to(bench.now);
    shot = bench.ping->shot;
    Echogram echo = echo_of(shot, 0, 0);
    for (std::size_t i = 0; i < echo.values.size(); ++i) echo.values[i] = power(i % shot.bins);
    for (const Send& send : bench.device().heard(echo, bench.ping->due).send)
        if (send.port == water_column) {
            std::vector<float> column(u32(send.bytes, 36));
            for (std::size_t r = 0; r < column.size(); ++r) column[r] = f32(send.bytes, 192 + 4 * 256 * r);
            return {column, u32(send.bytes, 52)};
        }
    return {};
}

TEST(NorbitWbms, ARowIsTheMeanPowerOfItsBins) {
    for (const auto& [range, bins_of_row] : {std::pair("set_range 2.01 7", std::size_t{1}),
                                             {"set_range 2.01 12", std::size_t{2}},
                                             {"set_range 2.01 17", std::size_t{3}}}) {
        Shot shot;
        const auto even = first_column(range, shot, [](std::size_t) { return 1e10F; }).first;
        const auto [ramp, t0] =
            first_column(range, shot, [](std::size_t bin) { return 1e10F * static_cast<float>(bin + 1); });
        const auto first_bin = static_cast<std::size_t>(std::lround(shot.first_bin_time * 78125));
        ASSERT_EQ(even.size(), ramp.size());
        ASSERT_NEAR(static_cast<double>(shot.bins) / static_cast<double>(ramp.size()),
                    static_cast<double>(bins_of_row), 0.1);
        for (std::size_t r = 1; r + 1 < ramp.size(); ++r) {
            const std::size_t from = (t0 + r) * bins_of_row - bins_of_row / 2 - first_bin;
            const double mean = static_cast<double>(2 * from + bins_of_row + 1) / 2;
            ASSERT_NEAR(std::pow(ramp[r] / even[r], 2), mean, 1e-4 * mean) << range << ", row " << r;
        }
    }
}

}  // namespace
}  // namespace echoloop::test
