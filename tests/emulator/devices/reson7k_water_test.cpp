// The samples of the 7k multibeam: 7011 and 7018, what the flags of 7042 leave of them, and the
// intensities of 7027.
#include <cmath>

#include "tests/emulator/devices/reson7k_bench.h"

namespace echoloop::test {
namespace {

TEST(Reson7k, ImagesShowTheEchoInItsRow) {
    Reson sonar;
    sonar.answer(control(1051, {3, 7011, 7018, 7004}));
    const Seen geometry = sonar.next(7004);
    EXPECT_EQ(geometry.bytes.size(), 64U + 12 + 4 * 4 * 256 + 4);
    EXPECT_NEAR(geometry.get<float>(12 + 4 * 256), -70 * M_PI / 180, 1e-6) << "beam 0 is to port";
    const Seen image = sonar.next(7011);
    const auto width = image.get<std::uint32_t>(6), height = image.get<std::uint32_t>(10);
    EXPECT_EQ(width, 256U);
    EXPECT_LE(height, 1024U);
    const auto per_row = (image.get<std::uint32_t>(20) + height - 1) / height;
    const std::size_t head = image.bytes.size() - 4 - 64 - width * height;
    EXPECT_EQ(head, 56U);
    for (std::uint32_t row = 0; row < height; ++row)
        EXPECT_EQ(image.get<std::uint8_t>(head + row * width + 128) > 0, row == 400 / per_row) << row;
    const Seen beams = sonar.next(7018);
    EXPECT_GT(beams.packets, 30U);
    EXPECT_EQ(beams.get<std::uint16_t>(14), 256U);
    const auto samples = beams.get<std::uint32_t>(16);
    EXPECT_EQ(beams.bytes.size(), 64U + 52 + 4U * 256 * samples + 4);
    EXPECT_GT(beams.get<std::uint16_t>(52 + 4 * (400 * 256 + 9)), 100U);
    EXPECT_EQ(beams.get<std::uint16_t>(52 + 4 * (399 * 256 + 9)), 0U);
    EXPECT_EQ(beams.get<std::int16_t>(52 + 4 * (400 * 256 + 9) + 2), 0) << "the same on either side";
}

TEST(Reson7k, GainRaisesTheImageByItsDecibels) {
    Reson sonar;
    sonar.echo_power = 1e9F;
    sonar.answer(control(1051, {1, 7018}));
    const auto amplitude = [&](double gain) {
        sonar.answer(control(1008, {f32(gain)}));
        sonar.next(7018);
        return static_cast<double>(sonar.next(7018).get<std::uint16_t>(52 + 4 * (400 * 256 + 9)));
    };
    const double low = amplitude(30), high = amplitude(50);
    EXPECT_NEAR(high / low, 10, 0.2);
}

TEST(Reson7k, IntensitiesAreAmplitudesOf7018AtThePointsWithTheirGains) {
    Reson sonar;
    sonar.echo_power = 1e9F;
    sonar.answer(control(1051, {2, 7027, 7018}));
    const auto at_gain = [&](double gain) {
        sonar.answer(control(1008, {f32(gain)}));
        sonar.next(7018);
        const Seen points = sonar.next(7027), beams = sonar.next(7018);
        EXPECT_EQ(points.get<std::uint32_t>(14), 256U);
        const double intensity = points.get<float>(99 + 34 * 9 + 22);
        EXPECT_NEAR(intensity, beams.get<std::uint16_t>(52 + 4 * (400 * 256 + 9)), 0.03 * intensity + 1);
        return intensity;
    };
    const double low = at_gain(30), high = at_gain(50);
    EXPECT_GT(low, 20);
    EXPECT_NEAR(high / low, 10, 1e-3);
    sonar.echo_power = 1e20F;
    EXPECT_EQ(at_gain(80), 65535) << "clipped";
}

/// 7611 and 7612, as a calibration sends them.
TEST(Reson7k, RecordsOfLossesSetTheTimeVariedGainOfTheNextPing) {
    Reson sonar;
    sonar.echo_power = 5e8F;
    sonar.answer(control(1051, {3, 7000, 7503, 7018}));
    const auto amplitude = [&](double absorption, double spreading) {
        sonar.say(record_of_float(7611, f32(absorption)));
        sonar.say(record_of_float(7612, f32(spreading)));
        EXPECT_TRUE(records_of(sonar.sent()).empty()) << "records are not answered";
        sonar.next(7018);
        const Seen settings = sonar.next(7000);
        EXPECT_FLOAT_EQ(settings.get<float>(142), static_cast<float>(absorption));
        EXPECT_FLOAT_EQ(settings.get<float>(150), static_cast<float>(spreading));
        EXPECT_FLOAT_EQ(sonar.next(7503).get<float>(136), static_cast<float>(absorption));
        return static_cast<double>(sonar.next(7018).get<std::uint16_t>(52 + 4 * (400 * 256 + 9)));
    };
    const double range = 400.5 / 34500 * 750, flat = amplitude(0, 0);
    EXPECT_GT(flat, 10);
    const double absorbed = amplitude(400, 40), spread = amplitude(0, 40);
    EXPECT_NEAR(spread / flat, range * range, 0.05 * range * range);
    EXPECT_NEAR(absorbed / spread, std::pow(10, 2 * 0.4 * range / 20), 0.02);
    for (const std::uint32_t wrong : {f32(-1), f32(1e3), std::uint32_t{0x7FC00000}})
        for (const std::uint32_t type : {7611U, 7612U}) sonar.say(record_of_float(type, wrong));
    sonar.next(7018);
    EXPECT_FLOAT_EQ(sonar.next(7000).get<float>(142), 0);
    EXPECT_FLOAT_EQ(sonar.next(7503).get<float>(144), 40);
}

/// What a ping with these flags has in 7042 and in 7018.
struct Water : Reson {
    explicit Water(std::uint32_t flags) : Reson(Options{{"beams", std::int64_t{16}}, {"range", 20.0}}) {
        EXPECT_EQ(answer(control(1051, {2, 7018, 7042})), 0U);
        EXPECT_EQ(answer(control(7042, {flags})), 0U);
        next(7042);
        while (packed.bytes.empty() && now < Time(3s)) {
            run_to(now + 1ms);
            for (const Seen& record : records_of(sent())) (record.type() == 7018 ? whole : packed) = record;
        }
        EXPECT_EQ(packed.get<std::uint32_t>(8), whole.get<std::uint32_t>(8)) << "one ping";
        EXPECT_EQ(packed.get<std::uint16_t>(14), 16U) << "beams";
        EXPECT_EQ(packed.get<std::uint32_t>(16), samples()) << "nominal";
        EXPECT_EQ(packed.get<std::uint32_t>(24), flags);
        EXPECT_EQ(packed.get<std::uint32_t>(28), 0U) << "first sample";
    }
    std::uint32_t samples() const { return whole.get<std::uint32_t>(16); }
    template <class T>
    T of_whole(std::uint32_t sample, std::size_t beam, std::size_t offset) const {
        return whole.get<T>(52 + 4 * (sample * 16 + beam) + offset);
    }
    /// Calls look(beam, its samples, where they begin), each of `size` bytes.
    template <class Look>
    void each_beam(std::size_t size, const Look& look) const {
        std::size_t at = 44;
        std::uint32_t most = 0;
        for (std::uint16_t beam = 0; beam < 16; ++beam) {
            ASSERT_EQ(packed.get<std::uint16_t>(at), beam);
            const auto count = packed.get<std::uint32_t>(at + 2);
            most = std::max(most, count);
            look(beam, count, at + 6);
            at += 6 + size * count;
        }
        EXPECT_EQ(packed.bytes.size(), 64 + at + 4);
        EXPECT_EQ(packed.get<std::uint32_t>(20), most) << "compressed samples";
    }
    Seen whole, packed;
};

TEST(Reson7kWater, WithoutFlagsItHasAllSamplesBeamByBeam) {
    const Water w(0);
    EXPECT_EQ(w.packed.get<float>(32), 34500.0F);
    w.each_beam(4, [&](std::size_t beam, std::uint32_t count, std::size_t at) {
        ASSERT_EQ(count, w.samples());
        for (std::uint32_t i = 0; i < count; ++i)
            ASSERT_EQ(w.packed.get<std::uint32_t>(at + 4 * i), w.of_whole<std::uint32_t>(i, beam, 0));
    });
}

TEST(Reson7kWater, ItEndsATenthBeyondTheBottomAndLeavesPhasesOut) {
    const Water w(1 | 2);
    w.each_beam(2, [&](std::size_t beam, std::uint32_t count, std::size_t at) {
        EXPECT_NEAR(count, 1.1 * 400.5, 3) << beam;
        EXPECT_GT(w.packed.get<std::uint16_t>(at + 2 * 400), 100U);
        for (std::uint32_t i = 0; i < count; ++i)
            ASSERT_EQ(w.packed.get<std::uint16_t>(at + 2 * i), w.of_whole<std::uint16_t>(i, beam, 0));
    });
}

TEST(Reson7kWater, EightBitsAreDecibelsAndTheUpperByteOfThePhase) {
    const Water w(4);
    w.each_beam(2, [&](std::size_t beam, std::uint32_t count, std::size_t at) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto amplitude = w.of_whole<std::uint16_t>(i, beam, 0);
            const double db = amplitude == 0 ? 0 : std::floor(40 * std::log10(amplitude) + 0.5);
            ASSERT_EQ(w.packed.get<std::uint8_t>(at + 2 * i), db);
            ASSERT_EQ(w.packed.get<std::uint8_t>(at + 2 * i + 1), w.of_whole<std::uint8_t>(i, beam, 3));
        }
    });
}

TEST(Reson7kWater, OneOfSeveralSamplesIsTheirMiddleTheirPeakOrTheirMean) {
    for (const std::uint32_t kind : {1U, 2U, 3U}) {
        const Water w(2 | 5 << 4 | kind << 8);
        EXPECT_EQ(w.packed.get<float>(32), 34500.0F / 5) << "rate";
        w.each_beam(2, [&](std::size_t beam, std::uint32_t count, std::size_t at) {
            ASSERT_EQ(count, w.samples() / 5);
            for (std::uint32_t i = 0; i < count; ++i) {
                unsigned peak = 0, sum = 0;
                for (std::uint32_t k = 0; k < 5; ++k) {
                    const unsigned one = w.of_whole<std::uint16_t>(5 * i + k, beam, 0);
                    peak = std::max(peak, one), sum += one;
                }
                const unsigned middle = w.of_whole<std::uint16_t>(5 * i + 2, beam, 0);
                const unsigned expected[] = {middle, peak, sum / 5};
                ASSERT_EQ(w.packed.get<std::uint16_t>(at + 2 * i), expected[kind - 1]) << kind;
            }
        });
    }
}

TEST(Reson7kWater, FlagsThatCannotBeAreRefused) {
    Reson sonar;
    EXPECT_EQ(sonar.answer(control(7042)), 0x7008U);
    EXPECT_EQ(sonar.answer(control(7042, {8})), 0x7001U) << "absolute gates";
    EXPECT_EQ(sonar.answer(control(7042, {0x110})), 0x7001U) << "every sample is no thinning";
    EXPECT_EQ(sonar.answer(control(7042, {0x420})), 0x7001U) << "no such thinning";
    EXPECT_EQ(sonar.answer(control(7042, {1U << 13})), 0x7001U);
    EXPECT_EQ(sonar.answer(control(7042, {0x10})), 0U) << "a divisor that is not used";
    EXPECT_EQ(sonar.answer(control(1050, {7042})), 0x700AU) << "subscription only";
}

}  // namespace
}  // namespace echoloop::test
