// What floats in the water and waves: their part of the echo is new at every ping, the rest stays.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "tests/render/acoustics/chain_shots.h"
#include "tests/render/acoustics/statistics.h"

namespace echoloop {
namespace {

using test::chain_shot;

constexpr float power = 1e14F;  ///< uPa^2, far above the noise

/// Two pings of a sonar at rest, over each other's mean.
struct TwoPings {
    double mean, correlation;
};

/// `fresh`: of the mean power, in all bins.
TwoPings two_pings(Shot shot, Effects effects, double fresh) {
    constexpr std::size_t per_step = 16;
    const std::size_t beams = shot.bearings.size(), steps = (shot.bins + per_step - 1) / per_step;
    const std::vector<float> fresh_steps(beams * steps, static_cast<float>(fresh) * power);
    AcousticChain chain(effects);
    std::vector<float> pings[2];
    for (auto& values : pings) {
        ++shot.ping;
        values.assign(beams * shot.bins, power);
        chain.apply(shot, {}, test::water_speed, {}, values, {fresh_steps, per_step});
    }
    return {intensity_statistics(pings[1]).mean, correlation(pings[0], pings[1])};
}

// Of two fields that have the share s of their power in common, intensities correlate by s^2.
TEST(FreshPower, IsNewAtEveryPingAndTheRestStays) {
    const Effects all = test::only({Effect::pulse, Effect::speckle, Effect::noise});
    Shot alike = chain_shot(64, 500, 0.05, 0.05);
    alike.horizontal.ways = alike.vertical.ways = 1;  // the echo is heard as the noise is
    Shot other = alike;
    other.receiver.bandwidth = 40e3;  // Hz, of the noise; that of the echo is 15
    for (const auto& [shot, effects, name] :
         {std::tuple(alike, all, "noise that sounds alike"),
          {other, all, "other noise"},
          {alike, test::only({Effect::pulse, Effect::speckle}), "no noise"}})
        for (const double fresh : {0.0, 0.3, 0.7, 1.0}) {
            const TwoPings two = two_pings(shot, effects, fresh);
            const std::string what = std::string(name) + ", fresh " + std::to_string(fresh);
            EXPECT_NEAR(two.mean / two_pings(shot, test::only({Effect::pulse}), 0).mean, 1, 0.03) << what;
            EXPECT_NEAR(two.correlation, std::pow(1 - fresh, 2), 0.04) << what;
        }
}

}  // namespace
}  // namespace echoloop
