// The Oculus sonars on the bench: messages laid out by hand and read by the offsets of the specification.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/emulator/devices/driver.h"

namespace echoloop::test {
namespace {

using namespace std::chrono_literals;

template <class T>
T at(const Bytes& bytes, std::size_t offset) {
    T value{};
    if (offset + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

template <class T>
void put(Bytes& bytes, T value) {
    const auto raw = std::bit_cast<std::array<std::uint8_t, sizeof value>>(value);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

struct Wish {
    int mode = 1, rate = 0, speed = 255, gamma = 255, flags = 0x09;
    double range = 10, gain = 50, sound_speed = 1500, salinity = 35;
    std::uint32_t ext_flags = 0;
};

Bytes fire(const Wish& w, bool v2 = false) {
    Bytes bytes = from_hex(v2 ? "534f0000000015000200490000000000" : "534f0000000015000000250000000000");
    for (const int byte : {w.mode, w.rate, w.speed, w.gamma, w.flags})
        put(bytes, static_cast<std::uint8_t>(byte));
    for (const double number : {w.range, w.gain, w.sound_speed, w.salinity}) put(bytes, number);
    if (v2) put(bytes, w.ext_flags), bytes.resize(89);
    return bytes;
}

bool is_result(const Send& send) { return send.port == 0 && at<std::uint16_t>(send.bytes, 6) == 0x23; }
bool is_dummy(const Send& send) { return to_hex(send.bytes) == "534fe9030000ff000000000000000000"; }

/// A result by the offsets of its version.
struct Seen {
    Bytes bytes;
    bool v2;
    explicit Seen(Bytes b) : bytes(std::move(b)), v2(at<std::uint16_t>(bytes, 8) == 2) {}

    template <class T>
    T get(std::size_t v1_offset, std::size_t v2_offset) const {
        return at<T>(bytes, v2 ? v2_offset : v1_offset);
    }
    std::uint32_t ping() const { return get<std::uint32_t>(53, 89); }
    double sound_speed() const { return get<double>(85, 145); }
    std::size_t sample_bytes() const { return get<std::uint8_t>(97, 161) + 1U; }
    double resolution() const { return get<double>(98, 162); }
    std::size_t ranges() const { return get<std::uint16_t>(106, 170); }
    std::size_t beams() const { return get<std::uint16_t>(108, 172); }
    std::size_t image_offset() const { return get<std::uint32_t>(110, 190); }
    std::size_t image_size() const { return get<std::uint32_t>(114, 194); }
    std::int16_t bearing(std::size_t i) const { return at<std::int16_t>(bytes, (v2 ? 202 : 122) + 2 * i); }
    bool gain_words() const { return (bytes[20] & 4) != 0; }
    std::size_t row_at(std::size_t row) const {
        return image_offset() + row * (beams() * sample_bytes() + (gain_words() ? 4 : 0));
    }
    std::uint32_t gain_word(std::size_t row) const { return at<std::uint32_t>(bytes, row_at(row)); }
    double sample(std::size_t row, std::size_t beam) const {
        const std::size_t offset = row_at(row) + (gain_words() ? 4 : 0) + beam * sample_bytes();
        if (sample_bytes() == 1) return bytes.at(offset);
        return sample_bytes() == 2 ? at<std::uint16_t>(bytes, offset) : at<std::uint32_t>(bytes, offset);
    }
};

struct OculusBench : Bench {
    explicit OculusBench(const Options& changes = {}, const std::string& model = "oculus-m1200d")
        : Bench(make_device(model, {}, changes)) {
        device().reconnected(0);
    }
    /// The next result after `bytes`.
    Seen next_after(const Bytes& bytes) {
        say(bytes);
        return next();
    }
    Seen next() {
        for (const Time end = now + 5s; now < end; run_to(now + 1ms))
            for (Send& send : sent())
                if (is_result(send)) return Seen(std::move(send.bytes));
        ADD_FAILURE() << "no result";
        return Seen({});
    }
    std::vector<Send> sent_within(Time time) {
        run_to(now + time);
        return sent();
    }
};

std::size_t count(const std::vector<Send>& sends, bool (*what)(const Send&)) {
    return static_cast<std::size_t>(std::count_if(sends.begin(), sends.end(), what));
}

TEST(OculusStatus, ComesOnceASecondAndHas142Bytes) {
    OculusBench bench({{"status_bits", std::int64_t{0x4003}}});
    bench.run_to(3500ms);
    std::vector<Send> status;
    for (const Send& send : bench.sent())
        if (send.port == 1) status.push_back(send);
    ASSERT_EQ(status.size(), 4U) << "at 0, 1, 2 and 3 s";
    EXPECT_EQ(status[0].to, (Address{0x7FFFFFFF, 52102})) << "loopback's broadcast";
    const Bytes& s = status.back().bytes;
    ASSERT_EQ(s.size(), 142U);
    EXPECT_EQ(at<std::uint16_t>(s, 0), 0x4F53);
    EXPECT_EQ(at<std::uint16_t>(s, 2), 1001);
    EXPECT_EQ(at<std::uint32_t>(s, 10), 126U);
    EXPECT_EQ(at<std::uint32_t>(s, 16), 1001U) << "the source of its header, too";
    EXPECT_EQ(at<std::uint16_t>(s, 20), 1);
    EXPECT_EQ(at<std::uint16_t>(s, 22), 1042);
    EXPECT_EQ(at<std::uint32_t>(s, 24), 0x4003U);
    EXPECT_EQ(to_hex(ByteView(s).subspan(52, 12)), "7f000001ffffff007f000001");
    EXPECT_EQ(at<double>(s, 70), 10);
}

TEST(OculusStatus, TellsTheModelTheAddressAndTheClient) {
    const std::pair<const char*, int> models[] = {
        {"oculus-m370s", 1041}, {"oculus-m750d", 1032}, {"oculus-m1200d", 1042}, {"oculus-m3000d", 2203}};
    for (const auto& [model, part] : models) {
        Bench bench(make_device(model, {"tcp-listen://192.168.2.4:52100", "udp://192.168.2.255:52102"}));
        bench.run_to(100ms);
        const auto first = bench.sent();
        ASSERT_FALSE(first.empty());
        EXPECT_EQ(first[0].to, (Address{0xC0A802FF, 52102}));
        EXPECT_EQ(at<std::uint16_t>(first[0].bytes, 22), part) << model;
        EXPECT_EQ(to_hex(ByteView(first[0].bytes).subspan(52, 12)), "c0a80204ffffff0000000000");
        bench.say(fire({}), 0, {0xC0A80207, 40000});
        bench.run_to(1100ms);
        for (const Send& send : bench.sent())
            if (send.port == 1) {
                EXPECT_EQ(to_hex(ByteView(send.bytes).subspan(60, 4)), "c0a80207");
            }
    }
}

TEST(OculusEndpoints, ThatLeadNowhereAreRefused) {
    const auto refused = [](std::vector<std::string> endpoints) {
        EXPECT_THROW(make_device("oculus-m750d", std::move(endpoints)), std::invalid_argument);
    };
    refused({"tcp-listen://0.0.0.0:52100", "udp://192.168.2.255:52102"});
    refused({"tcp-listen://127.0.0.1:52100", "udp://192.168.2.255:52102"});
    refused({"tcp-listen://192.168.2.4:52100"});
    refused({"tcp-listen://127.0.0.1:52100", "udp-listen://127.0.0.1:52102"});
}

TEST(OculusStandby, IsTheStateBeforeTheFirstFireAndKeepsADummyASecond) {
    OculusBench bench;
    auto sends = bench.sent_within(3500ms);
    EXPECT_EQ(count(sends, is_dummy), 4U);
    EXPECT_EQ(count(sends, is_result), 0U);
    bench.say(fire({}));
    sends = bench.sent_within(3s);
    EXPECT_EQ(count(sends, is_dummy), 0U);
    EXPECT_EQ(count(sends, is_result), 30U) << "one fire, free running at 10 Hz";
    bench.say(fire({.rate = 5}));
    bench.sent_within(100ms);
    sends = bench.sent_within(3s);
    EXPECT_EQ(count(sends, is_dummy), 3U);
    EXPECT_EQ(count(sends, is_result), 0U);
    bench.say(fire({.rate = 3}));
    EXPECT_EQ(count(bench.sent_within(2s), is_result), 10U);
}

TEST(OculusStandby, IsTheStateThatAnotherHostFinds) {
    OculusBench bench;
    bench.next_after(fire({}));
    bench.device().reconnected(0);
    bench.sent();
    const auto sends = bench.sent_within(3s);
    EXPECT_EQ(count(sends, is_result), 0U);
    EXPECT_EQ(count(sends, is_dummy), 3U);
}

TEST(OculusStandby, IsForcedByOverTemperature) {
    OculusBench bench({{"status_bits", std::int64_t{0x8003}}});
    bench.say(fire({}));
    const auto sends = bench.sent_within(3500ms);
    EXPECT_EQ(count(sends, is_result), 0U);
    EXPECT_EQ(count(sends, is_dummy), 4U);
}

TEST(OculusResult, OfVersion1EchoesTheFireAndStandsWhereItShould) {
    OculusBench bench;
    const Bytes request =
        fire({.mode = 1, .flags = 0x0D, .range = 12.34, .gain = 61.5, .sound_speed = 1480.25});
    const Seen first = bench.next_after(request);
    EXPECT_EQ(to_hex(ByteView(first.bytes).first(10)), "534fe903000023000000");
    EXPECT_EQ(at<std::uint32_t>(first.bytes, 10) + 16, first.bytes.size());
    EXPECT_EQ(to_hex(ByteView(first.bytes).subspan(16, 37)), to_hex(ByteView(request).subspan(16)));
    EXPECT_EQ(first.sound_speed(), 1480.25);
    EXPECT_EQ(at<double>(first.bytes, 61), 1.2e6);
    EXPECT_EQ(at<double>(first.bytes, 69), 10);
    EXPECT_EQ(at<std::uint32_t>(first.bytes, 57), 0U) << "status";
    EXPECT_EQ(first.beams(), 256U);
    EXPECT_EQ(first.image_size(), first.ranges() * (256 + 4));
    EXPECT_EQ(first.image_offset() + first.image_size(), first.bytes.size());
    EXPECT_EQ(at<std::uint32_t>(first.bytes, 118), first.bytes.size());
    EXPECT_EQ(first.image_offset(), 2048U);
    const Seen second = bench.next();
    EXPECT_EQ(second.ping(), first.ping() + 1);
    EXPECT_EQ(at<std::uint32_t>(second.bytes, 93) - at<std::uint32_t>(first.bytes, 93), 100'000'000U) << "ns";
}

TEST(OculusResult, OfVersion2HasItsOwnPlacesAndAnAttitude) {
    OculusBench bench;
    const Bytes request = fire({.flags = 0x4D, .range = 5}, true);
    bench.say(request);
    bench.run_to(bench.now);
    ASSERT_TRUE(bench.ping);
    Echogram echogram = echo_of(bench.ping->shot, 3, 1e12F);
    // Looks south of east, 20 deg down, at 4 m depth.
    echogram.world_from_sonar = {{0, 0, -4}, from_rpy(deg_to_rad(5), deg_to_rad(20), deg_to_rad(-30))};
    const auto actions = bench.device().heard(echogram, bench.ping->due);
    ASSERT_EQ(actions.send.size(), 1U);
    const Seen seen(actions.send[0].bytes);
    EXPECT_EQ(at<std::uint16_t>(seen.bytes, 8), 2);
    EXPECT_EQ(to_hex(ByteView(seen.bytes).subspan(16, 73)), to_hex(ByteView(request).subspan(16)));
    EXPECT_EQ(seen.beams(), 512U);
    EXPECT_EQ(seen.image_size(), seen.ranges() * (512 + 4));
    EXPECT_EQ(at<std::uint32_t>(seen.bytes, 198), seen.bytes.size());
    EXPECT_NEAR(at<double>(seen.bytes, 113), 0.402, 0.001) << "bar at 4 m";
    EXPECT_NEAR(at<double>(seen.bytes, 121), 120, 1e-9) << "compass heading";
    EXPECT_NEAR(at<double>(seen.bytes, 129), -20, 1e-9) << "nose down";
    EXPECT_NEAR(at<double>(seen.bytes, 137), 5, 1e-9) << "starboard down";
    EXPECT_EQ(at<double>(seen.bytes, 153), 0) << "fired at power-up";
}

TEST(OculusTiming, FollowsRangeAndRate) {
    struct Row {
        const char* model;
        int mode, rate;
        double range, period;
    };
    // Longest of 1 / rate and 2 R / c + 2 ms, at 1500 m/s.
    const Row rows[] = {{"oculus-m1200d", 2, 0, 2, 0.1},
                        {"oculus-m1200d", 2, 1, 2, 1 / 15.0},
                        {"oculus-m1200d", 2, 2, 2, 0.025},
                        {"oculus-m1200d", 1, 3, 40, 0.2},
                        {"oculus-m1200d", 1, 4, 40, 0.5},
                        {"oculus-m1200d", 1, 2, 40, 80 / 1500.0 + 0.002},
                        {"oculus-m370s", 1, 0, 200, 400 / 1500.0 + 0.002}};
    for (const Row& row : rows) {
        OculusBench bench({}, row.model);
        bench.say(fire({.mode = row.mode, .rate = row.rate, .range = row.range}));
        bench.run_to(bench.now);
        ASSERT_TRUE(bench.ping) << "at once";
        EXPECT_NEAR(to_seconds(bench.ping->due), 2 * row.range / 1500 + 0.002, 1e-6) << row.model << row.rate;
        const Time before = bench.ping->due;
        bench.next();
        bench.next();
        EXPECT_NEAR(to_seconds(bench.now - before), row.period, 0.0021) << row.model << row.rate;
    }
}

TEST(OculusTiming, ANewFireTakesEffectWithTheNextPing) {
    OculusBench bench;
    bench.say(fire({.rate = 2, .range = 30}));
    bench.run_to(10ms);
    bench.say(fire({.rate = 2, .range = 5}));
    EXPECT_EQ(at<double>(bench.next().bytes, 21), 30) << "the ping that was under way";
    const Seen second = bench.next();
    EXPECT_EQ(at<double>(second.bytes, 21), 5);
    EXPECT_NEAR(static_cast<double>(second.ranges()) * second.resolution(), 5, second.resolution());
    for (int i = 0; i < 20; ++i) bench.say(fire({.rate = 2, .range = 5})), bench.run_to(bench.now + 5ms);
    EXPECT_LE(count(bench.sent(), is_result), 4U) << "a fire for each picture does not raise the rate";
}

TEST(OculusTiming, ASlowNetworkBoundsTheRate) {
    OculusBench bench;
    const Seen seen = bench.next_after(fire({.rate = 2, .speed = 5}));
    const Time first = bench.now;
    bench.next();
    EXPECT_NEAR(to_seconds(bench.now - first), 8e-6 * static_cast<double>(seen.bytes.size()) / 5, 0.004);
}

TEST(OculusRange, IsRowsTimesResolutionAndBoundedByTheMode) {
    OculusBench bench;
    // As in the real capture: 703 rows of c / (2 * 262237.76 Hz) for 2 m at 1490.6586 m/s.
    const Seen real = bench.next_after(fire({.mode = 2, .range = 2, .sound_speed = 1490.6586}));
    EXPECT_EQ(real.ranges(), 703U);
    EXPECT_NEAR(real.resolution(), 2.8421889710794e-3, 1e-9);
    EXPECT_NEAR(at<double>(real.bytes, 61), 2098880.597, 1e-3);
    const auto reach = [&](const Wish& wish) {
        bench.say(fire(wish));
        bench.next();
        const Seen seen = bench.next();
        EXPECT_LE(seen.ranges(), 1024U);
        return static_cast<double>(seen.ranges()) * seen.resolution();
    };
    EXPECT_NEAR(reach({.mode = 2, .range = 10}), 10, 0.01);
    EXPECT_NEAR(reach({.mode = 2, .range = 99}), 10, 0.01) << "the mode's longest";
    EXPECT_NEAR(reach({.mode = 1, .range = 99}), 40, 0.05);
    EXPECT_NEAR(reach({.mode = 1, .flags = 0x08, .range = 25}), 10, 0.05) << "percent of 40 m";
    EXPECT_NEAR(reach({.mode = 1, .range = -5}), 0.1, 0.01);
}

TEST(OculusBearings, AreEqualInSineOverTheModesSector) {
    OculusBench bench;
    const Seen high = bench.next_after(fire({.mode = 2}));
    for (std::size_t i = 0; i < 256; ++i) {
        const double degrees = std::asin(-0.5 + static_cast<double>(i) / 255) * 180 / M_PI;
        EXPECT_EQ(high.bearing(i), std::trunc(100 * degrees + std::copysign(1e-9, degrees))) << i;
    }
    bench.say(fire({.mode = 1, .flags = 0x49}));
    bench.next();
    const Seen low = bench.next();
    ASSERT_EQ(low.beams(), 512U);
    EXPECT_EQ(low.bearing(0), -6500);
    EXPECT_EQ(low.bearing(511), 6500);
    const auto sine = [&](std::size_t i) { return std::sin(low.bearing(i) * M_PI / 18000); };
    for (std::size_t i = 1; i < 512; ++i)
        EXPECT_NEAR(sine(i) - sine(i - 1), 2 * std::sin(65 * M_PI / 180) / 511, 3e-4);
    OculusBench m370s({}, "oculus-m370s");
    EXPECT_EQ(m370s.next_after(fire({.flags = 0x49})).beams(), 256U) << "the most that it has";
}

TEST(OculusImage, HasAnEchoInItsRowAndNowhereElse) {
    for (const int flags : {0x09, 0x0B, 0x0D, 0x4F, 0x1D}) {
        OculusBench bench;
        bench.echo_bin = 100, bench.echo_power = 1e13F;
        const Seen seen = bench.next_after(fire({.flags = flags}));
        for (std::size_t row = 0; row < seen.ranges(); ++row)
            for (std::size_t beam = 0; beam < seen.beams(); beam += 51)
                ASSERT_EQ(seen.sample(row, beam) > 0, row == 100) << flags << ' ' << row << ' ' << beam;
    }
}

TEST(OculusImage, ReadsTheSameInEveryDataSize) {
    const auto share = [](const Bytes& request, double full) {
        OculusBench bench;
        bench.echo_bin = 50, bench.echo_power = 1e13F;
        return bench.next_after(request).sample(50, 7) / full;
    };
    const double bits8 = share(fire({}, true), 254), bits16 = share(fire({.flags = 0x0B}, true), 65535);
    const double bits32 = share(fire({.flags = 0x0B, .ext_flags = 0x200}, true), 4294967295.0);
    EXPECT_GT(bits16, 0.1);
    EXPECT_NEAR(bits8, bits16, 1 / 254.0);
    EXPECT_NEAR(bits32, bits16, 1 / 65535.0);
}

TEST(OculusImage, GainRaisesTheEchoAndGainWordsTakeItOutAgain) {
    const auto seen = [](double gain, int flags, int mode = 1) {
        OculusBench bench;
        bench.echo_bin = 50, bench.echo_power = 1e11F;
        return bench.next_after(fire({.mode = mode, .flags = flags, .gain = gain}));
    };
    const Seen low = seen(20, 0x0F), high = seen(80, 0x0F);
    const double span = 30;  // dB from 0 to 100 %
    EXPECT_NEAR(20 * std::log10(high.sample(50, 9) / low.sample(50, 9)), 0.6 * span, 0.1);
    const auto amplitude = [](const Seen& s) { return s.sample(50, 9) / std::sqrt(s.gain_word(50)); };
    EXPECT_NEAR(amplitude(high) / amplitude(low), 1, 0.01);
    EXPECT_GT(low.gain_word(900), low.gain_word(50)) << "time-varied gain";
    // 0 to 100 % is 40 to 100 % in high frequency, and echoed so.
    EXPECT_EQ(at<double>(seen(50, 0x0F, 2).bytes, 29), 70);
    EXPECT_EQ(at<double>(seen(50, 0x0F, 1).bytes, 29), 50);
}

TEST(OculusImage, GammaLiftsTheDark) {
    const auto share = [](int gamma) {
        OculusBench bench;
        bench.echo_bin = 50, bench.echo_power = 1e11F;
        return bench.next_after(fire({.gamma = gamma, .flags = 0x0B})).sample(50, 9) / 65535;
    };
    const double linear = share(255);
    EXPECT_GT(linear, 0.01);
    EXPECT_LT(linear, 0.3);
    EXPECT_EQ(share(0), linear);
    EXPECT_NEAR(share(127), std::sqrt(linear), 1e-4);
    EXPECT_NEAR(share(191), std::pow(linear, 0.75), 1e-3);
    EXPECT_NEAR(share(63), std::pow(linear, 0.25), 1e-3);
}

TEST(OculusImage, GainAssistKeepsARowWithinFullScale) {
    const auto sample = [](int flags) {
        OculusBench bench;
        bench.echo_bin = 50, bench.echo_power = 1e17F;
        const Seen seen = bench.next_after(fire({.flags = flags}));
        return std::pair(seen.sample(50, 9), seen.gain_word(50));
    };
    const auto [clipped, gain] = sample(0x0D);
    const auto [whole, assisted] = sample(0x1D);
    EXPECT_EQ(clipped, 254);
    EXPECT_LE(whole, 254);
    EXPECT_GT(whole, 200);
    EXPECT_LT(assisted, gain);
}

TEST(OculusSoundSpeed, IsTheHostsOrFollowsFromTemperatureAndSalinity) {
    OculusBench bench({{"temperature", 15.0}});
    const auto used = [&](const Wish& wish) {
        bench.say(fire(wish));
        bench.next();
        return bench.next();
    };
    EXPECT_EQ(used({.sound_speed = 1523.5}).sound_speed(), 1523.5);
    // Medwin 1975 at 15 degC: published values are 1506.6 (sea) and 1465.9 (fresh).
    const Seen sea = used({.sound_speed = 0, .salinity = 35});
    EXPECT_NEAR(sea.sound_speed(), 1506.6, 0.5);
    EXPECT_EQ(at<double>(sea.bytes, 37), 0) << "echoed as requested";
    EXPECT_NEAR(used({.sound_speed = 0, .salinity = 0}).sound_speed(), 1465.9, 1.5);
    EXPECT_NEAR(sea.resolution() / sea.sound_speed(),
                1 / (2 * 150e3) * std::ceil(10 / (sea.sound_speed() / 300e3) / 1024), 1e-9);
}

TEST(OculusOptions, ChangeWhatTheSpecificationLeavesOpen) {
    const auto seen = [](const Options& options, const Wish& wish, bool v2 = false) {
        OculusBench bench(options);
        bench.echo_bin = 20, bench.echo_power = 1e12F;
        return bench.next_after(fire(wish, v2));
    };
    using S = std::string;
    EXPECT_EQ(seen({{"data_16_bit", S("clear")}}, {.flags = 0x09}).sample_bytes(), 2U);
    EXPECT_EQ(seen({{"data_16_bit", S("clear")}}, {.flags = 0x0B}).sample_bytes(), 1U);
    EXPECT_EQ(at<double>(seen({{"gain_echo", S("plain")}}, {.mode = 2}).bytes, 29), 50);
    EXPECT_NEAR(at<double>(seen({{"sound_speed_echo", S("used")}}, {.sound_speed = 0}).bytes, 37), 1490, 5);
    EXPECT_EQ(seen({{"rate_echo", S("useless")}}, {}).bytes[17], 195);
    EXPECT_EQ(at<double>(seen({{"sensors", S("garbage")}}, {}).bytes, 77), -1e194);
    const Wish percent{.flags = 0x0B, .range = 50, .ext_flags = 0x200};
    const Seen half = seen({{"range_in_32_bit", S("percent")}}, percent, true);
    EXPECT_NEAR(static_cast<double>(half.ranges()) * half.resolution(), 20, 0.1) << "half of 40 m";
    const Seen words = seen({{"gain_word", S("f32")}}, {.flags = 0x0D});
    EXPECT_EQ(std::bit_cast<float>(words.gain_word(20)),
              static_cast<float>(seen({}, {.flags = 0x0D}).gain_word(20)));
}

TEST(OculusOptions, NegativeBearingsMayBeStarboard) {
    for (const bool starboard : {false, true}) {
        OculusBench bench({{"negative_bearing", std::string(starboard ? "starboard" : "port")}});
        bench.say(fire({}));
        bench.run_to(bench.now);
        Echogram echogram = echo_of(bench.ping->shot, 0, 0);
        echogram.values[10 * echogram.shot.bins + 20] = 1e14F;  // beam 10 is to port
        const Seen seen(bench.device().heard(echogram, bench.ping->due).send.at(0).bytes);
        EXPECT_GT(seen.sample(20, starboard ? 245 : 10), 0);
        EXPECT_EQ(seen.sample(20, starboard ? 10 : 245), 0);
    }
}

TEST(OculusFire, ThatMakesNoSenseIsRefusedAndChangesNothing) {
    OculusBench bench;
    bench.say(fire({.range = 7}));
    for (const Wish& wish : {Wish{.mode = 0}, Wish{.mode = 3}, Wish{.range = std::nan("")},
                             Wish{.gain = INFINITY}, Wish{.sound_speed = -INFINITY}})
        bench.say(fire(wish));
    EXPECT_EQ(at<double>(bench.next().bytes, 21), 7);
    EXPECT_EQ(at<double>(bench.next().bytes, 21), 7);
    EXPECT_EQ(bench.device().counters().rejected, 5U);
    EXPECT_EQ(bench.next_after(fire({.rate = 77, .gain = 1e300, .sound_speed = 1e9})).sound_speed(), 1700);
}

TEST(OculusFire, OnANoisyLineIsObeyedAgainWithinOneMessage) {
    std::mt19937 random(7);
    OculusBench bench;
    for (int round = 0; round < 300; ++round) {
        for (int i = 0; i < 5; ++i) {
            Bytes bytes = fire({.mode = 1 + i % 2, .range = 2.0 + i}, i % 3 == 0);
            for (std::uint8_t& byte : bytes)
                if (random() % 20 == 0) byte ^= static_cast<std::uint8_t>(1 + random() % 255);
            bench.say(bytes);
            bench.run_to(bench.now + std::chrono::milliseconds(random() % 20));
        }
        const double range = 3 + round / 1000.0;
        bench.sent();
        bench.say(fire({.rate = 2, .range = range}));
        bool obeyed = false;
        for (int pings = 0; pings < 2 && !obeyed; ++pings)
            obeyed = at<double>(bench.next().bytes, 21) == range;
        ASSERT_TRUE(obeyed) << "round " << round;
        bench.shots.clear();
    }
}

}  // namespace
}  // namespace echoloop::test
