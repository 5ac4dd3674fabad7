// What a DVL measures: velocities, ranges, modes, dead reckoning. Its words are in dvl_commands_test.cpp and
// dvl_serial_test.cpp.
#include "tests/emulator/devices/dvl_bench.h"

namespace echoloop::test {
namespace {

double number(const Json& json, const char* key) { return json.at(key).get<double>(); }

TEST(Dvl, ShotHasFourBeamsOfTheJanus) {
    for (const char* name : {"dvl-a50", "dvl-a125"}) {
        const Shot shot = find_model(name)->default_shot(make_config(*find_model(name)), 0, 0);
        ASSERT_EQ(shot.beams(), 4U);
        ASSERT_EQ(shot.sides.size(), 4U);
        std::set<std::size_t> ids;
        for (const double bearing : shot.bearings) ids.insert(id_of(bearing));
        EXPECT_EQ(ids.size(), 4U);
        for (const Side& side : shot.sides) EXPECT_NEAR(rad_to_deg(side.depression), 67.5, 1e-9);
    }
}

TEST(Dvl, ReportHasTheKeysOfARealOneInTheirOrder) {
    DvlBench dvl;
    dvl.run_to(3s);
    std::string last;
    for (const std::string& line : dvl.texts(json_port))
        if (line.find("\"type\":\"velocity\"") != std::string::npos) last = line;
    ASSERT_TRUE(last.ends_with("}\r\n"));
    EXPECT_LT(last.size(), 2048U) << "libwaterlinked stalls on longer ones";
    EXPECT_EQ(last.find(' '), std::string::npos);
    const auto json = nlohmann::ordered_json::parse(last);
    std::string keys, beam_keys;
    for (const auto& [key, value] : json.items()) keys += key + ' ';
    for (const auto& [key, value] : json.at("transducers").at(0).items()) beam_keys += key + ' ';
    EXPECT_EQ(keys,
              "time vx vy vz fom covariance altitude transducers velocity_valid status format type "
              "time_of_validity time_of_transmission ");
    EXPECT_EQ(beam_keys, "id velocity distance rssi nsd beam_valid ");
    EXPECT_EQ(json.at("format"), "json_v3.3");
    EXPECT_TRUE(json.at("time_of_validity").is_number_integer());
    EXPECT_GT(json.at("time_of_transmission"), json.at("time_of_validity"));
    EXPECT_NEAR(1e-6 * json.at("time_of_validity").get<double>(), 1.75e9 + 3, 0.5);
}

TEST(Dvl, VelocityIsForwardStarboardDown) {
    for (const auto& [velocity, x, y, z] : {std::tuple{Vec3{0.5, 0, 0}, 0.5, 0.0, 0.0},
                                            {Vec3{0, 0.3, 0}, 0.0, -0.3, 0.0},
                                            {Vec3{0, 0, 0.2}, 0.0, 0.0, -0.2}}) {
        DvlBench dvl;
        dvl.velocity = velocity;
        const Json report = dvl.reports("velocity", 4s).back();
        ASSERT_TRUE(report.at("velocity_valid"));
        EXPECT_NEAR(number(report, "vx"), x, 1e-4);
        EXPECT_NEAR(number(report, "vy"), y, 1e-4);
        EXPECT_NEAR(number(report, "vz"), z, 1e-4);
    }
}

// The published sample: v and the four transducers' velocities.
TEST(Dvl, BeamsHaveTheVelocitiesOfAPublishedSample) {
    DvlBench dvl({{"noise", 0.0}});
    dvl.velocity = {0.0097571, -0.0020161, 0.0002865};
    const Json report = dvl.reports("velocity", 4s).back();
    const double published[] = {-0.00235, -0.00345, 0.00184, 0.00290};
    for (std::size_t id = 0; id < 4; ++id) {
        EXPECT_EQ(report.at("transducers").at(id).at("id"), id);
        EXPECT_NEAR(number(report.at("transducers").at(id), "velocity"), published[id], 3e-5) << id;
    }
}

TEST(Dvl, PortIsNotStarboard) {
    for (std::size_t deaf = 0; deaf < 4; ++deaf) {
        DvlBench dvl;
        dvl.deaf = deaf;
        const Json report = dvl.reports("velocity", 4s).back();
        EXPECT_TRUE(report.at("velocity_valid")) << "three beams do";
        for (std::size_t id = 0; id < 4; ++id) {
            const Json& beam = report.at("transducers").at(id);
            EXPECT_EQ(beam.at("beam_valid"), id != deaf);
            EXPECT_NEAR(number(beam, "distance"), id == deaf ? -1 : 5 / std::cos(deg_to_rad(22.5)), 0.02);
        }
    }
}

TEST(Dvl, AltitudeIsAlongZAndLessByTheOffset) {
    DvlBench dvl({{"altitude_offset", 0.015}});
    for (const double altitude : {0.4, 2.0, 9.0, 20.0, 40.0}) {
        dvl.altitude = altitude;
        const auto reports = dvl.reports("velocity", dvl.bench.now + 8s);
        EXPECT_NEAR(number(reports.back(), "altitude"), altitude - 0.015, 0.005 * altitude + 0.002)
            << altitude;
    }
}

TEST(Dvl, RangesAndVelocitiesFollowItsOwnSoundSpeed) {
    DvlBench dvl({{"speed_of_sound", 1470.0}});
    dvl.velocity = {1, 0, 0};
    const Json report = dvl.reports("velocity", 4s).back();
    EXPECT_NEAR(number(report, "vx"), 0.98, 2e-4);
    EXPECT_NEAR(number(report, "altitude"), 0.98 * 5 - 0.015, 0.02);
}

TEST(Dvl, FigureOfMeritIsTheLargestEigenvaluesRoot) {
    DvlBench dvl({{"noise", 1e-3}, {"noise_by_altitude", 0.0}, {"noise_by_speed", 0.0}});
    const Json report = dvl.reports("velocity", 4s).back();
    const Json covariance = report.at("covariance");
    EXPECT_NEAR(covariance[0][0].get<double>(), 3.415e-6, 0.01e-6) << "four beams at 22.5 deg";
    EXPECT_NEAR(covariance[1][1].get<double>(), 3.415e-6, 0.01e-6);
    EXPECT_NEAR(covariance[2][2].get<double>(), 0.293e-6, 0.001e-6);
    EXPECT_NEAR(number(report, "fom"), std::sqrt(3.415e-6), 2e-6);
}

TEST(Dvl, NoiseIsThatOfTheCovariance) {
    DvlBench dvl({{"bias", 0.0}, {"noise", 2e-3}, {"range_mode", std::string("=2")}}, "dvl-a50", true);
    const auto reports = dvl.reports("velocity", 120s);
    ASSERT_GT(reports.size(), 400U);
    double sum = 0, fom = 0;
    for (const Json& report : reports) {
        sum += std::pow(number(report, "vx"), 2);
        fom += number(report, "fom");
    }
    const double deviation = std::sqrt(sum / static_cast<double>(reports.size()));
    EXPECT_NEAR(deviation / (fom / static_cast<double>(reports.size())), 1, 0.15);
}

TEST(Dvl, WithoutABottomItSaysSo) {
    DvlBench dvl;
    dvl.altitude = 0;
    const auto reports = dvl.reports("velocity", 10s);
    ASSERT_GT(reports.size(), 7U) << "every 0.43 to 1.25 s";
    ASSERT_LT(reports.size(), 25U);
    for (const Json& report : reports) {
        EXPECT_FALSE(report.at("velocity_valid"));
        EXPECT_EQ(report.at("altitude"), -1);
        EXPECT_EQ(report.at("vx"), 0);
        EXPECT_EQ(report.at("fom"), 2.66);
        EXPECT_EQ(report.at("transducers").at(3).at("distance"), -1);
        EXPECT_FALSE(report.at("transducers").at(3).at("beam_valid"));
    }
}

TEST(Dvl, TooFastIsInvalid) {
    DvlBench dvl;
    dvl.velocity = {3.9, 0, 0};
    EXPECT_FALSE(dvl.reports("velocity", 4s).back().at("velocity_valid"));
    DvlBench larger({}, "dvl-a125");
    larger.velocity = {3.9, 0, 0};
    EXPECT_TRUE(larger.reports("velocity", 4s).back().at("velocity_valid"));
}

// The maker's table: mode 0 pings at 15 Hz, 1 at 10, 2 at 5 to 6, 3 at 7 to 8, 4 at 2 to 4.
TEST(Dvl, RateFollowsTheAltitude) {
    for (const auto& [altitude, least, most] :
         {std::tuple{0.2, 14, 15}, {1.0, 9, 10}, {7.0, 5, 6}, {25.0, 7, 8}, {45.0, 2, 4}}) {
        DvlBench dvl({{"periodic_cycling", false}});
        dvl.altitude = altitude;
        dvl.run_to(10s);
        const auto count = static_cast<int>(dvl.reports("velocity", 20s).size());
        EXPECT_GE(count, 10 * least) << altitude;
        EXPECT_LE(count, 10 * most + 1) << altitude;
    }
}

TEST(Dvl, LockedModeHasNoBottomElsewhere) {
    DvlBench dvl({{"range_mode", std::string("=1")}});
    EXPECT_FALSE(dvl.reports("velocity", 5s).back().at("velocity_valid")) << "5 m is beyond mode 1";
    dvl.altitude = 2;
    EXPECT_TRUE(dvl.reports("velocity", 10s).back().at("velocity_valid"));
}

TEST(Dvl, CyclingFindsANearerBottomAndLosesPings) {
    DvlBench cycling, steady({{"periodic_cycling", false}});
    for (DvlBench* dvl : {&cycling, &steady}) dvl->run_to(5s);
    EXPECT_LT(cycling.reports("velocity", 65s).size(), steady.reports("velocity", 65s).size());
}

TEST(Dvl, DeadReckoningComesHome) {
    DvlBench dvl;
    dvl.run_to(3s);
    dvl.ask(R"({"command":"reset_dead_reckoning"})");
    dvl.velocity = {1, 0.5, 0};
    dvl.run_to(3s + 100ms);
    const Json begin = dvl.reports("position_local", 13s).front(),
               end = dvl.reports("position_local", 23s).back();
    EXPECT_NEAR(number(end, "x") - number(begin, "x"), number(end, "ts") - number(begin, "ts"), 0.3);
    EXPECT_NEAR(number(end, "y") - number(begin, "y"), -0.5 * (number(end, "ts") - number(begin, "ts")), 0.2)
        << "y is to starboard";
    EXPECT_GT(number(end, "std"), number(begin, "std"));
}

TEST(Dvl, YawIsClockwiseAndZeroAtTheReset) {
    DvlBench dvl;
    dvl.yaw = 1;
    dvl.turning = {0, 0, -deg_to_rad(2)};
    const auto positions = dvl.reports("position_local", 20s);
    EXPECT_NEAR(number(positions.back(), "yaw"), 40, 2) << "from where it looked at first";
    dvl.ask(R"({"command":"reset_dead_reckoning"})");
    const Json reset = dvl.reports("position_local", dvl.bench.now + 300ms).back();
    EXPECT_NEAR(number(reset, "yaw"), 0, 1);
}

TEST(Dvl, MountingOffsetTurnsTheVelocityAndNotTheBeams) {
    DvlBench dvl({{"mounting_rotation_offset", 90.0}});
    dvl.velocity = {0.5, 0, 0};
    const Json report = dvl.reports("velocity", 4s).back();
    EXPECT_NEAR(number(report, "vx"), 0, 1e-4);
    EXPECT_NEAR(number(report, "vy"), 0.5, 1e-4);
    EXPECT_GT(number(report.at("transducers").at(3), "velocity"), 0.1);
}

TEST(Dvl, WaterTrackingHasATypeOfItsOwn) {
    DvlBench dvl({{"range_mode", std::string("wt")}});
    dvl.altitude = 0;
    dvl.velocity = {0.4, 0, 0};
    const auto reports = dvl.reports("velocity_water", 10s);
    ASSERT_NEAR(static_cast<double>(reports.size()), 20, 2) << "2 Hz";
    EXPECT_NEAR(number(reports.back(), "vx"), 0.4, 1e-3);
    EXPECT_EQ(reports.back().at("altitude"), -1);
    DvlBench plain({{"range_mode", std::string("wt")}, {"water_type", std::string("velocity")}});
    EXPECT_FALSE(plain.reports("velocity", 2s).empty());
}

TEST(Dvl, SaysNothingWhileItBoots) {
    DvlBench dvl({{"boot_time", 20.0}});
    dvl.run_to(10s);
    dvl.say(R"({"command":"get_config"})");
    dvl.run_to(19s + 990ms);
    EXPECT_TRUE(dvl.bench.sent().empty());
    EXPECT_FALSE(dvl.reports("velocity", 30s).empty());
}

TEST(Dvl, HeatShowsInTheStatusAndStopsIt) {
    DvlBench warm({{"temperature", 52.0}}), hot({{"temperature", 56.0}});
    EXPECT_EQ(warm.reports("velocity", 3s).back().at("status"), 1);
    EXPECT_TRUE(hot.reports("velocity", 3s).empty());
}

}  // namespace
}  // namespace echoloop::test
