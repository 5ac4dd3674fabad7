// The Sonar 3D-15 as a state machine: what each request changes, which packets go where and when. Requests
// are text; packets are read by the offsets of the specification.
#include "tests/emulator/devices/sonar_3d_15_bench.h"

namespace echoloop::test {
namespace {

constexpr std::uint32_t group = 0xE0000060;  // 224.0.0.96

TEST(Sonar3d15, IsSilentUntilAHostEnablesItsAcoustics) {
    SonarBench sonar;
    EXPECT_FALSE(sonar.bench->ping.has_value());
    EXPECT_TRUE(sonar.packets_until(1s).empty());
    EXPECT_EQ(sonar.get("/acoustics/enabled"), "false");
    EXPECT_EQ(sonar.post("/acoustics/enabled", "true"), 204);
    EXPECT_TRUE(sonar.bench->ping.has_value());
    const auto packets = sonar.packets_until(1s + 200ms);
    ASSERT_EQ(packets.size(), 2U);
    EXPECT_EQ(sonar.post("/acoustics/enabled", "false"), 204);
    EXPECT_TRUE(sonar.packets_until(3s).empty());
    EXPECT_FALSE(sonar.bench->ping.has_value());
    EXPECT_EQ(sonar.post("/acoustics/enabled", "true"), 204);
    EXPECT_EQ(sonar.packets_until(3s + 200ms).size(), 2U);
}

TEST(Sonar3d15, SendsARangeImageAndThenItsStrengthsSixTimesASecond) {
    SonarBench sonar(pinging);
    EXPECT_TRUE(sonar.packets_until(166ms).empty());
    const auto packets = sonar.packets_until(1s);
    ASSERT_EQ(packets.size(), 12U);
    for (std::size_t i = 0; i < packets.size(); i += 2) {
        EXPECT_EQ(packets[i].to, (Address{group, 4747}));
        const SeenImage range(packets[i].bytes), strength(packets[i + 1].bytes);
        EXPECT_EQ(range.type_url, "type.googleapis.com/waterlinked.sonar.protocol.RangeImage");
        EXPECT_EQ(strength.type_url, "type.googleapis.com/waterlinked.sonar.protocol.BitmapImageGreyscale8");
        EXPECT_EQ(range.message.blocks.at(1), strength.message.blocks.at(1)) << "one header a shot";
        EXPECT_EQ(range.sequence(), i / 2);
        EXPECT_NEAR(range.seconds(), 1.75e9 + 0.25 + static_cast<double>(i / 2) / 6, 1e-6);
        EXPECT_FALSE(strength.message.numbers.contains(5)) << "type 0 is absent";
    }
    const SeenImage range(packets[0].bytes), strength(packets[1].bytes);
    for (const auto& [image, first] : {std::pair(range, 5), std::pair(strength, 6)}) {
        EXPECT_EQ(image.message.real(2), 1500.0F);
        EXPECT_EQ(image.message.real(3), 15.0F);
        EXPECT_EQ(image.message.numbers.at(4), 5U);
        EXPECT_EQ(image.message.numbers.at(first), 256U);
        EXPECT_EQ(image.message.numbers.at(first + 1), 64U);
        EXPECT_EQ(image.message.real(first + 2), 90.0F);
        EXPECT_EQ(image.message.real(first + 3), 40.0F);
    }
    EXPECT_EQ(range.message.real(9), 50.0F / 65536);
}

TEST(Sonar3d15, AMessageThatReadersSkipFollowsTheImagesIfToldTo) {
    Options options = pinging;
    options.emplace("other_messages", true);
    SonarBench sonar(options);
    const auto packets = sonar.packets_until(400ms);
    ASSERT_EQ(packets.size(), 6U);
    for (const std::size_t i : {2U, 5U})
        EXPECT_EQ(SeenImage(packets[i].bytes).type_url,
                  "type.googleapis.com/waterlinked.sonar.protocol.Undocumented");
    EXPECT_EQ(SeenImage(packets[3].bytes).sequence(), 1U);
}

TEST(Sonar3d15, PixelsAreTheStrongestEchoOfTheirDirection) {
    SonarBench sonar(pinging);
    const auto packets = sonar.packets_until(200ms);
    const double bin = 14.5 / 384;  // 0.5 to 15 m
    const auto distances = SeenImage(packets.at(0).bytes).distances();
    const Bytes strengths = SeenImage(packets.at(1).bytes).message.blocks.at(10);
    ASSERT_EQ(distances.size(), image_width * image_height);
    ASSERT_EQ(strengths.size(), distances.size());
    for (std::size_t i = 0; i < distances.size(); ++i) {
        ASSERT_NEAR(distances[i], 0.5 + 100.5 * bin, 0.001) << i;
        ASSERT_EQ(strengths[i], strengths[0]);
    }
    EXPECT_GT(strengths[0], 100);
    sonar.bench->echo_power = 1e15F;  // 10 dB less: the amplitude by sqrt(10), 100 log10 of that is 50
    const auto weaker = sonar.packets_until(400ms);
    EXPECT_EQ(SeenImage(weaker.at(1).bytes).message.blocks.at(10)[0], strengths[0] - 50);
}

TEST(Sonar3d15, ABeamIsThePixelInItsRowAndColumn) {
    for (const bool up : {false, true}) {
        Options options = pinging;
        options.emplace("first_row", std::string(up ? "up" : "down"));
        SonarBench sonar(options);
        const Shot shot = sonar.bench->ping->shot;
        ASSERT_EQ(shot.bearings.size(), image_width);
        ASSERT_EQ(shot.elevations.size(), image_height);
        Echogram echo = echo_of(shot, 0, 0);
        const std::size_t row = 5, column = 200;  // low, to starboard
        echo.values[(row * image_width + column) * shot.bins + 77] = 1e16F;
        const auto sent = sonar.bench->device().heard(echo, sonar.bench->ping->due).send;
        const auto distances = SeenImage(sent.at(0).bytes).distances();
        for (std::size_t pixel = 0; pixel < distances.size(); ++pixel) {
            const bool here = pixel == (up ? 63 - row : row) * image_width + column;
            ASSERT_NEAR(distances[pixel], here ? 0.5 + 77.5 * 14.5 / 384 : 0, 0.001) << pixel;
        }
        EXPECT_NEAR(rad_to_deg(shot.elevations[row]), -20 + 5 * 40.0 / 63, 1e-9);
        EXPECT_NEAR(rad_to_deg(shot.bearings[column]), -45 + 200 * 90.0 / 255, 1e-9);
    }
}

TEST(Sonar3d15, NothingHeardIsZeroInBothImages) {
    SonarBench sonar(pinging);
    sonar.bench->echo_power = 0;
    const auto packets = sonar.packets_until(200ms);
    EXPECT_EQ(SeenImage(packets.at(0).bytes).distances(), std::vector<double>(image_width * image_height, 0));
    EXPECT_EQ(SeenImage(packets.at(1).bytes).message.blocks.at(10), Bytes(image_width * image_height, 0));
}

TEST(Sonar3d15, RangeChangesTheNextShotAndComesBackAsPosted) {
    SonarBench sonar(pinging);
    EXPECT_EQ(sonar.get("/acoustics/range"), R"({"min":0.5,"max":15.0})");
    sonar.packets_until(50ms);
    EXPECT_EQ(sonar.post("/acoustics/range", R"({"min": 2.0, "max": 3.0})"), 204);
    EXPECT_EQ(sonar.get("/acoustics/range"), R"({"min":2.0,"max":3.0})");
    sonar.bench->echo_bin = 25;
    EXPECT_TRUE(sonar.packets_until(333ms).empty()) << "the image under way is dropped";
    const auto packets = sonar.packets_until(334ms);
    ASSERT_EQ(packets.size(), 2U);
    const Shot& shot = sonar.bench->shots.back();
    EXPECT_NEAR(shot.first_bin_time, 2 * 2.0 / 1500, 1e-9);
    EXPECT_NEAR(shot.bin_interval * static_cast<double>(shot.bins), 2 * 1.0 / 1500, 1e-9);
    const SeenImage range(packets[0].bytes);
    EXPECT_EQ(range.message.real(3), 3.0F);
    EXPECT_NEAR(range.distances()[0], 2 + 25.5 / static_cast<double>(shot.bins), 0.001);
}

TEST(Sonar3d15, SpeedOfSoundScalesDistancesAndZeroIsAutomatic) {
    SonarBench sonar(pinging);
    EXPECT_EQ(sonar.post("/acoustics/speed_of_sound", "1442.0"), 204);
    EXPECT_EQ(sonar.get("/acoustics/speed_of_sound"), "1442.0");
    const auto packets = sonar.packets_until(400ms);
    EXPECT_EQ(SeenImage(packets.at(0).bytes).message.real(2), 1500.0F) << "the image under way keeps its own";
    EXPECT_EQ(SeenImage(packets.at(2).bytes).message.real(2), 1442.0F);
    EXPECT_NEAR(sonar.bench->shots.back().bin_interval, 2 * 14.5 / 384 / 1442, 1e-9);
    EXPECT_EQ(sonar.post("/acoustics/speed_of_sound", "0"), 204);
    EXPECT_EQ(sonar.post("/acoustics/salinity", R"("fresh")"), 204);
    // Fresh water of 10 degC: 1447.3 m/s (Del Grosso & Mader 1972)
    const auto fresh = sonar.packets_until(800ms);
    EXPECT_NEAR(SeenImage(fresh.at(2).bytes).message.real(2), 1447.3, 2);
    EXPECT_EQ(sonar.post("/acoustics/salinity", R"("salt")"), 204);
    // Sea water of 10 degC and 35 ppt: 1489.8 m/s (Mackenzie 1981)
    const auto salt = sonar.packets_until(1200ms);
    EXPECT_NEAR(SeenImage(salt.at(2).bytes).message.real(2), 1489.8, 0.2);
    EXPECT_EQ(sonar.get("/acoustics/speed_of_sound"), "0.0");
}

TEST(Sonar3d15, ANewSpeedOfSoundMayTakeItsTime) {
    Options options = pinging;
    options.emplace("speed_delay", 1.0);
    SonarBench sonar(options);
    EXPECT_EQ(sonar.post("/acoustics/speed_of_sound", "1442"), 204);
    EXPECT_EQ(sonar.get("/acoustics/speed_of_sound"), "1442.0");
    EXPECT_EQ(SeenImage(sonar.packets_until(1s).back().bytes).message.real(2), 1500.0F);
    EXPECT_EQ(SeenImage(sonar.packets_until(1400ms).back().bytes).message.real(2), 1442.0F);
}

TEST(Sonar3d15, TheHighFrequencyIsFasterAndNarrower) {
    SonarBench sonar(pinging);
    EXPECT_EQ(sonar.get("/acoustics/mode"), R"("low-frequency")");
    EXPECT_DOUBLE_EQ(sonar.bench->ping->shot.frequency, 1.2e6);
    EXPECT_EQ(sonar.post("/acoustics/mode", R"("high-frequency")"), 204);
    EXPECT_EQ(sonar.get("/acoustics/mode"), R"("high-frequency")");
    const auto packets = sonar.packets_until(500ms);
    ASSERT_EQ(packets.size(), 12U) << "from 200 ms on, when the shot of the low frequency is over";
    const SeenImage first(packets[0].bytes), second(packets[2].bytes);
    EXPECT_EQ(first.message.real(7), 40.0F);
    EXPECT_EQ(first.message.real(8), 40.0F);
    EXPECT_NEAR(second.seconds() - first.seconds(), 0.05, 1e-6);
    EXPECT_DOUBLE_EQ(sonar.bench->shots.back().frequency, 2.4e6);
}

TEST(Sonar3d15, ImagesGoWhereAHostWantsThem) {
    SonarBench sonar(pinging);
    const std::string unicast =
        R"({"mode":"unicast","unicast_destination_ip":"127.0.0.1","unicast_destination_port":4748})";
    EXPECT_EQ(sonar.get("/udp"),
              R"({"mode":"multicast","unicast_destination_ip":"","unicast_destination_port":0})");
    EXPECT_EQ(sonar.post("/udp", unicast), 204);
    EXPECT_EQ(sonar.get("/udp"), unicast);
    EXPECT_EQ(sonar.packets_until(200ms).at(0).to, (Address{0x7F000001, 4748}));
    const std::string kept =
        R"({"mode":"disabled","unicast_destination_ip":"10.0.0.7","unicast_destination_port":1})";
    EXPECT_EQ(sonar.post("/udp", kept), 204);
    EXPECT_EQ(sonar.get("/udp"), kept);
    EXPECT_TRUE(sonar.packets_until(400ms).empty());
    EXPECT_EQ(sonar.post("/udp", R"({"mode":"unicast","unicast_destination_ip":"192.168.99.42",)"
                                 R"("unicast_destination_port":4748})"),
              204);
    EXPECT_TRUE(sonar.packets_until(600ms).empty()) << "a sonar on loopback sends to loopback only";
}

TEST(Sonar3d15, ASecondEndpointIsWhereImagesGoFromTheStart) {
    SonarBench sonar(pinging, {"tcp-listen://127.0.0.1:8080", "udp://127.0.0.1:5000"});
    EXPECT_EQ(sonar.packets_until(200ms).at(0).to, (Address{0x7F000001, 5000}));
    EXPECT_EQ(sonar.get("/udp"),
              R"({"mode":"unicast","unicast_destination_ip":"127.0.0.1","unicast_destination_port":5000})");
    EXPECT_THROW(SonarBench({}, {"pty:/tmp/x"}), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop::test
