// Record 7042 of the 7k multibeam: what its flags leave of the samples of 7018.
#include <cmath>

#include "tests/emulator/devices/reson7k_bench.h"

namespace echoloop::test {
namespace {

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
