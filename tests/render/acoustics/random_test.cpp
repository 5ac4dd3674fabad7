// Random numbers: known answers, how normal they are, and that none go together.
#include "render/acoustics/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "tests/render/acoustics/statistics.h"

namespace echoloop {
namespace {

TEST(Random, ThreefryKnownAnswers) {  // Random123's kat_vectors, threefry4x32, 13 rounds
    EXPECT_EQ(threefry({0, 0, 0, 0}, {0, 0, 0, 0}),
              (std::array<std::uint32_t, 4>{0x531c7e4f, 0x39491ee5, 0x2c855a92, 0x3d6abf9a}));
    EXPECT_EQ(threefry({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
                       {0xa4093822, 0x299f31d0, 0x082efa98, 0xec4e6c89}),
              (std::array<std::uint32_t, 4>{0x4aa71d8f, 0x734738c2, 0x431fc6a8, 0xae6debf1}));
}

TEST(Random, Normals) {
    constexpr std::size_t count = 1 << 20;
    std::vector<float> room(normals_room(count));
    const float* z = room.data() + normals({1, 2, 3, 4}, -1000, count, room.data());
    double mean = 0, square = 0, fourth = 0, next = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = static_cast<double>(z[i]);
        mean += x / count, square += x * x / count, fourth += x * x * x * x / count;
        if (i > 0) next += x * static_cast<double>(z[i - 1]) / count;
    }
    EXPECT_NEAR(mean, 0, 0.004);
    EXPECT_NEAR(square, 1, 0.006);
    EXPECT_NEAR(fourth, 3, 0.04);
    EXPECT_NEAR(next, 0, 0.004);
}

// The share of numbers below each of some places, out to where one in 30,000 lies.
TEST(Random, NormalsAreNormal) {
    constexpr std::size_t count = 1 << 22;
    std::vector<float> room(normals_room(count));
    const float* z = room.data() + normals({9, 8, 7, 6}, 12'345, count, room.data());
    for (const double place : {-4.0, -3.0, -2.0, -1.0, -0.3, 0.0, 0.1, 0.5, 1.5, 2.5, 3.5}) {
        const double below = 0.5 * std::erfc(-place / std::numbers::sqrt2);
        const auto found =
            std::count_if(z, z + count, [&](float x) { return static_cast<double>(x) < place; });
        const double of_polynomials = std::min(2e-5, 0.1 * std::min(below, 1 - below));
        EXPECT_NEAR(static_cast<double>(found) / count, below,
                    4.5 * std::sqrt(below * (1 - below) / count) + of_polynomials)
            << place;
    }
}

// Neither numbers nor their squares, which intensities follow, correlate with others: of the same stream,
// also those of one word, or of one whose name differs a little.
TEST(Random, StreamsAreIndependent) {
    constexpr std::size_t count = 1 << 16, lags[] = {1, 2, 15, 16, 17, 31, 32, 33, 128};
    constexpr double most = 4.5 / 256;  // standard deviations
    const auto of = [&](const RandomStream& stream, std::int64_t first) {
        std::vector<float> room(normals_room(count));
        const std::size_t at = normals(stream, first, count, room.data());
        return std::vector<float>(room.begin() + static_cast<std::ptrdiff_t>(at),
                                  room.begin() + static_cast<std::ptrdiff_t>(at + count));
    };
    const auto squares = [](std::vector<float> values) {
        for (float& x : values) x *= x;
        return values;
    };
    const RandomStream own{1, 2, 3, 4};
    const auto z = of(own, 0);
    const auto compare = [&](const std::vector<float>& other, const std::string& what) {
        EXPECT_NEAR(correlation(z, other), 0, most) << what;
        EXPECT_NEAR(correlation(squares(z), squares(other)), 0, most) << what;
    };
    for (const std::size_t lag : lags)
        compare(of(own, static_cast<std::int64_t>(lag)), "lag " + std::to_string(lag));
    for (std::uint32_t i = 1; i < 40; ++i) {
        const std::uint64_t bit = 1ULL << i;
        compare(of({1 ^ bit, 2, 3, 4}, 0), "key");
        compare(of({1, 2 ^ bit, 3, 4}, 0), "place");
        compare(of({1, 2, 3 + i, 4}, 0), "lane");
        compare(of({1, 2, 3, 4 + i}, 0), "kind");
    }
    compare(of({2, 1, 3, 4}, 0), "key and place change places");
    compare(of({1, 2, 4, 3}, 0), "lane and kind change places");
}

// The energy of sums, which filters over range take: of numbers that go together by a ten thousandth each it
// would be a hundredth more.
TEST(Random, SumsHaveTheEnergyOfTheirParts) {
    constexpr std::size_t count = 4096, lanes = 8000, lengths[] = {2, 16, 128};
    double energy[3] = {};
    std::vector<float> room(normals_room(count));
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
        const float* z = room.data() + normals({7, 123, lane, 1}, -100, count, room.data());
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t begin = 0; begin < count; begin += lengths[k]) {
                const double sum = std::accumulate(z + begin, z + begin + lengths[k], 0.0);
                energy[k] += sum * sum;
            }
    }
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(energy[k] / (count * lanes), 1,
                    4 * std::sqrt(2.0 * static_cast<double>(lengths[k]) / (count * lanes)))
            << lengths[k];
}

TEST(Random, NormalsAreAFunctionOfTheirNumber) {
    std::vector<float> all(normals_room(2000));
    const std::size_t zero = normals({1, 2, 3, 4}, -700, 2000, all.data()) + 700;
    for (const std::int64_t first : {-700, -129, -128, -1, 0, 5, 127, 128, 1000}) {
        std::vector<float> some(normals_room(200));
        const std::size_t at = normals({1, 2, 3, 4}, first, 200, some.data());
        for (std::size_t i = 0; i < 200; ++i)
            EXPECT_EQ(some[at + i], all[zero + i + static_cast<std::size_t>(first)]) << first << " " << i;
    }
}

/// A pool whose stretches begin at some places only could have favourites among them.
TEST(Random, EveryPlaceInATileIsDistributedAlike) {
    constexpr std::size_t tiles = 100, streams = 1000, count = tiles * normals_tile;
    std::vector<double> sum(normals_tile), squares(normals_tile);
    std::vector<float> room(normals_room(count));
    for (std::uint32_t lane = 0; lane < streams; ++lane) {
        const float* z = room.data() + normals({5, 6, lane, 7}, 0, count, room.data());
        for (std::size_t i = 0; i < count; ++i) {
            const double number = z[i];
            sum[i % normals_tile] += number, squares[i % normals_tile] += number * number;
        }
    }
    for (std::size_t place = 0; place < normals_tile; ++place) {
        EXPECT_NEAR(sum[place] / (tiles * streams), 0, 0.016) << place;      // 5 standard deviations
        EXPECT_NEAR(squares[place] / (tiles * streams), 1, 0.022) << place;  // the same
    }
}

TEST(Random, MixedNormalsAreThoseOfBothStreams) {
    constexpr std::size_t count = 700;
    const RandomStream one{1, 2, 3, 4}, other{1, 9, 3, 4};
    std::vector<float> a(normals_room(count)), b = a, mixed = a;
    for (const std::int64_t first : {-333, 0, 41}) {
        const std::size_t at = normals(one, first, count, a.data());
        EXPECT_EQ(normals(other, first, count, b.data()), at);
        EXPECT_EQ(mixed_normals({one, other}, {0.6F, -0.8F}, first, count, mixed.data()), at);
        for (std::size_t i = at; i < at + count; ++i)
            EXPECT_NEAR(mixed[i], 0.6F * a[i] - 0.8F * b[i], 1e-6) << i;
    }
}

}  // namespace
}  // namespace echoloop
