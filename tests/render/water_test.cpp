#include "render/water.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace echoloop {
namespace {

Water at(double temperature, double salinity, double depth, double ph) {
    return {temperature, salinity, ph, depth, std::nullopt};
}

struct Case {
    Water water;
    double kilohertz, db_per_km;
};

// Published check values of Francois & Garrison's equation.
TEST(Absorption, FrancoisGarrisonCheckValues) {
    Water with_speed = at(10, 35, 0, 8);
    with_speed.sound_speed = 1500;
    const Case cases[] = {{at(10, 35, 0, 8), 200, 54.446199},    {with_speed, 200, 54.047064},
                          {at(10, 35, 4000, 8), 200, 32.836398}, {at(10, 35, 0, 8), 31.23, 7.354640},
                          {at(10, 35, 0, 7.8), 200, 54.411284},  {at(10, 15.000012, 0, 8), 200, 31.259585},
                          {at(0.2, 35, 0, 8), 200, 40.702235}};
    for (const Case& c : cases)
        EXPECT_NEAR(absorption_db_per_km(c.water, c.kilohertz * 1e3), c.db_per_km, 1e-5);
}

TEST(Absorption, TableOfBothModels) {
    struct Row {
        double kilohertz, francois_garrison, ainslie_mccolm;
    };
    for (const Row& row : {Row{30, 6.87, 7.02}, Row{120, 38.8, 39.7}, Row{200, 54.4, 56.1},
                           Row{330, 79.5, 83.0}, Row{450, 109.7, 115.8}, Row{750, 222.4, 238.4},
                           Row{900, 299.5, 322.3}, Row{1200, 495, 536}, Row{2250, 1621, 1761}}) {
        const Water water = at(10, 35, 0, 8);
        EXPECT_NEAR(absorption_db_per_km(water, row.kilohertz * 1e3) / row.francois_garrison, 1, 2e-3)
            << row.kilohertz;
        EXPECT_NEAR(ainslie_mccolm_db_per_km(water, row.kilohertz * 1e3) / row.ainslie_mccolm, 1, 2e-3)
            << row.kilohertz;
    }
    for (const Row& row :
         {Row{115, 3.43, 3.72}, Row{450, 52.5, 56.9}, Row{750, 146.0, 158.1}, Row{900, 210.2, 227.7}}) {
        const Water fresh = at(15, 0, 5, 8);
        EXPECT_NEAR(absorption_db_per_km(fresh, row.kilohertz * 1e3) / row.francois_garrison, 1, 2e-3)
            << row.kilohertz;
        EXPECT_NEAR(ainslie_mccolm_db_per_km(fresh, row.kilohertz * 1e3) / row.ainslie_mccolm, 1, 2e-3)
            << row.kilohertz;
    }
}

TEST(Absorption, AinslieMcColmCheckValue) {
    EXPECT_NEAR(ainslie_mccolm_db_per_km(at(20, 35, 1, 8.1), 700e3) / 1000, 0.2146, 5e-5);
}

TEST(Absorption, SaysWhereTheFitEnds) {
    EXPECT_FALSE(absorption_is_extrapolated(1e6));
    EXPECT_TRUE(absorption_is_extrapolated(1.2e6));
}

// Two-way losses of the sonar equation.
TEST(TransmissionLoss, TwoWayAtPublishedRanges) {
    struct Row {
        double kilohertz, range, two_way_db;
    };
    for (const Row& row :
         {Row{750, 50, 90.20}, Row{900, 10, 45.99}, Row{900, 60, 107.06}, Row{2250, 5, 44.17}}) {
        const double absorption = absorption_db_per_km(at(10, 35, 0, 8), row.kilohertz * 1e3) / 1000;
        EXPECT_NEAR(2 * transmission_loss(row.range, absorption), row.two_way_db, 0.02) << row.kilohertz;
    }
}

// Mackenzie's own check value: 25 C, 35, 1000 m gives 1550.744 m/s.
TEST(SoundSpeed, MackenzieCheckValue) {
    EXPECT_NEAR(mackenzie_sound_speed(25, 35, 1000), 1550.744, 1e-3);
    EXPECT_NEAR(sound_speed(at(25, 35, 1000, 8)), 1550.744, 1e-3);
}

TEST(SoundSpeed, GivenOneWins) {
    Water water;
    water.sound_speed = 1531;
    EXPECT_EQ(sound_speed(water), 1531);
}

TEST(Decibel, NeperIsOfAmplitude) {
    EXPECT_NEAR(neper_to_db(1), 8.685889638, 1e-9);
    EXPECT_NEAR(db_to_neper(8.685889638), 1, 1e-9);
    // One way, the pressure falls by exp(-a R) and by a R dB; two ways, the power falls by exp(-4 a R) and by
    // 2 a R dB.
    const double db_per_metre = 0.3, range = 20, neper = db_to_neper(db_per_metre);
    EXPECT_NEAR(amplitude_to_db(std::exp(-neper * range)), -db_per_metre * range, 1e-9);
    EXPECT_NEAR(power_to_db(std::exp(-4 * neper * range)), -2 * db_per_metre * range, 1e-9);
}

TEST(Decibel, PowerTakesTenAndAmplitudeTwenty) {
    EXPECT_NEAR(power_to_db(2), 3.0103, 1e-4);
    EXPECT_NEAR(amplitude_to_db(2), 6.0206, 1e-4);
    EXPECT_NEAR(db_to_power(3.0103), 2, 1e-4);
    EXPECT_NEAR(db_to_amplitude(6.0206), 2, 1e-4);
}

TEST(WaterCheck, NamesTheValueThatIsWrong) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Water& bad :
         {at(nan, 35, 0, 8), at(99, 35, 0, 8), at(10, -1, 0, 8), at(10, 35, -5, 8), at(10, 35, 0, 99)})
        EXPECT_THROW(validate(bad), std::invalid_argument);
    Water slow;
    slow.sound_speed = 15;
    try {
        validate(slow);
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("sound_speed"), std::string::npos);
    }
    EXPECT_NO_THROW(validate(Water{}));
}

}  // namespace
}  // namespace echoloop
