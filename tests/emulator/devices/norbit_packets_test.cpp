// What commands and options of a Norbit WBMS change in its packets, read by the document's offsets.
#include "tests/emulator/devices/norbit_bench.h"

namespace echoloop::test {
namespace {

constexpr double unix_start = 1795298707.125;  // 2026-11-21 22:05:07.125 UTC

/// One packet of each kind, the first after these commands.
struct Packets {
    Bytes bathymetry, water_column;
    double transmitted = 0;  ///< s of run time
};

Packets packets_after(const std::vector<std::string>& said, const Options& changes = {}) {
    const Model& row = *find_model("norbit-wbms");
    DeviceConfig config = make_config(row, changes);
    config.unix_start = unix_start;
    Bench bench(row.make(config));
    bench.connect(water_column, host);
    bench.run_to(250ms);
    for (const std::string& command : said)
        EXPECT_THAT(ask(bench, command), testing::Not(testing::ContainsRegex("error|not set"))) << command;
    ask(bench, "set_power 1");
    bench.run_to(bench.now);
    Packets out{{}, {}, to_seconds(bench.now)};
    bench.run_to(bench.ping->due);
    for (const Send& send : bench.sent()) {
        if (send.port == bathymetry) out.bathymetry = send.bytes;
        if (send.port == water_column) out.water_column = send.bytes;
    }
    return out;
}

TEST(NorbitPackets, TellTheTransmittersDirectionAndTheGatesTilt) {
    const Packets p = packets_after({"set_tx_direction 12", "set_gate_tilt -5"});
    EXPECT_NEAR(f32(p.bathymetry, 72), deg_to_rad(12), 1e-6);
    EXPECT_NEAR(f32(p.bathymetry, 108), deg_to_rad(-5), 1e-6);
    EXPECT_NEAR(f32(p.water_column, 144), deg_to_rad(12), 1e-6);
    EXPECT_NEAR(f32(p.water_column, 156), deg_to_rad(-5), 1e-6);
}

TEST(NorbitPackets, OfABathymetricSystemThatLooksForwardAreImagesAlone) {
    EXPECT_FALSE(packets_after({}).bathymetry.empty());
    EXPECT_EQ(packets_after({}).water_column.at(153), 1);
    const Packets p = packets_after({"set_mode 0"});
    EXPECT_TRUE(p.bathymetry.empty());
    EXPECT_EQ(p.water_column.at(153), 0) << "FLS";
    EXPECT_EQ(u32(p.water_column, 4), 2U);
}

TEST(NorbitPackets, HaveUnixTimeOrTimeSinceStartup) {
    const Packets real = packets_after({"set_time_source 1"}), free = packets_after({"set_time_source 8"});
    for (const auto& [packet, sent] : {std::pair(&Packets::bathymetry, 48), {&Packets::water_column, 112}}) {
        EXPECT_NEAR(f64(real.*packet, 40), unix_start + real.transmitted, 1e-5);
        EXPECT_NEAR(f64(free.*packet, 40), free.transmitted, 1e-5);
        const auto at = static_cast<std::size_t>(sent);
        EXPECT_GT(f64(free.*packet, at), free.transmitted);
        EXPECT_LT(f64(free.*packet, at), free.transmitted + 1);
        EXPECT_GT(f64(real.*packet, at), unix_start);
    }
}

TEST(NorbitPackets, HaveAnalogGainsAsFloatsOrWholeNumbers) {
    const std::vector<std::string> constant{"set_vga 0", "set_gain 12"};
    const Bytes floats = packets_after(constant).water_column;
    EXPECT_EQ(f32(floats, 128), 12);
    EXPECT_EQ(f32(floats, 136), 12);
    const Options whole{{"water_column_vga", std::string("s32")}};
    const Bytes words = packets_after(constant, whole).water_column;
    EXPECT_EQ(u32(words, 128), 12U);
    EXPECT_EQ(u32(words, 136), 12U);
    const Bytes ramp = packets_after({}, whole).water_column;
    EXPECT_EQ(u32(ramp, 128), 0U);
    EXPECT_EQ(u32(ramp, 136), 40U);
    EXPECT_NEAR(u32(ramp, 132), 40 / (0.5 * 1500) * f32(ramp, 28), 1) << "50 dB per 100 m";
    const Bytes steep = packets_after({"set_vga 100"}, whole).water_column;
    EXPECT_NEAR(u32(steep, 132), 40 / (1.0 * 1500) * f32(steep, 28), 1);
    EXPECT_EQ(f32(packets_after({"set_vga 0", "set_gain 100"}).water_column, 128), 40)
        << "the amplifier's most";
}

TEST(NorbitPackets, HaveTheVersionOfTheOption) {
    const Packets usual = packets_after({}), other = packets_after({}, {{"version", std::int64_t{6}}});
    for (const auto packet : {&Packets::bathymetry, &Packets::water_column}) {
        EXPECT_EQ(u32(usual.*packet, 12), 4U);
        EXPECT_EQ(u32(other.*packet, 12), 6U);
        EXPECT_EQ(u32(other.*packet, 8), (other.*packet).size());
    }
}

}  // namespace
}  // namespace echoloop::test
