#include <gtest/gtest.h>

#include "tests/tools/made_up_echograms.h"
#include "tools/draw/chart.h"
#include "tools/draw/draw.h"
#include "tools/draw/palette.h"
#include "tools/draw/ticks.h"

namespace echoloop::draw {
namespace {

using test::fan;
using test::scan;
using test::spot;

/// A style that shows received levels between 0 dB (darkest) and 50 dB (brightest).
Style plain() {
    Style style;
    style.top = 50;
    style.span = 50;
    style.spreading = 0;
    return style;
}

int brightness(Color c) { return c.r + c.g + c.b; }

struct Place {
    double x = 0, y = 0;
};

/// Where a picture must show a point, from the frame that its sector is given.
Place expected(std::span<const Echogram> pings, double range, double bearing) {
    const Chart chart = Chart::fit(PolarScan(pings), 1000);
    return {chart.center_x + range * chart.scale * std::sin(bearing),
            chart.center_y - range * chart.scale * std::cos(bearing)};
}

/// Middle of the pixels in the sector that are as bright as the top of the scale.
Place brightest(const Image& image, std::span<const Echogram> pings) {
    const Chart chart = Chart::fit(PolarScan(pings), 1000);
    Place sum;
    int count = 0;
    for (int y = chart.top; y < chart.bottom; ++y)
        for (int x = chart.left; x < chart.right; ++x)
            if (brightness(image.at(x, y)) > 650 &&
                std::hypot(x - chart.center_x, y - chart.center_y) < 0.97 * chart.scale * 50) {
                sum.x += x + 0.5;
                sum.y += y + 0.5;
                ++count;
            }
    return count ? Place{sum.x / count, sum.y / count} : Place{-1, -1};
}

TEST(PolarPicture, shows_an_echo_to_starboard_on_the_right_at_its_range_and_bearing) {
    for (const double bearing : {-47.0, -10.0, 23.0, 52.0}) {
        const Echogram ping = fan(60, 256, 50, spot(30, deg_to_rad(bearing), 1.5, 1e6F, 1));
        const Image image = polar_picture({&ping, 1}, plain());
        const Place wanted = expected({&ping, 1}, 30, deg_to_rad(bearing));
        const Place seen = brightest(image, {&ping, 1});
        EXPECT_NEAR(seen.x, wanted.x, 2) << bearing;
        EXPECT_NEAR(seen.y, wanted.y, 2) << bearing;
        EXPECT_EQ(seen.x > 460, bearing > 0) << "the sonar stands at x = 460";
    }
}

TEST(PolarPicture, shows_the_full_turn_of_a_head_with_astern_below) {
    const auto pings = scan(0, 358.2, 1.8, 50, spot(35, deg_to_rad(200), 3, 1e6F, 1));
    const Image image = polar_picture(pings, plain());
    const Place wanted = expected(pings, 35, deg_to_rad(200)), centre = expected(pings, 0, 0);
    const Place seen = brightest(image, pings);
    EXPECT_NEAR(seen.x, wanted.x, 4);
    EXPECT_NEAR(seen.y, wanted.y, 4);
    EXPECT_LT(seen.x, centre.x) << "200 deg is port of astern";
    EXPECT_GT(seen.y, centre.y);
}

TEST(PolarPicture, has_the_colour_of_the_absolute_level) {
    for (const float db : {5.0F, 20.0F, 35.0F, 49.0F}) {
        const Echogram ping = fan(60, 64, 50, [=](double, double) { return std::pow(10.0F, db / 10); });
        const Image image = polar_picture({&ping, 1}, plain());
        const Place at = expected({&ping, 1}, 33, deg_to_rad(7.3));
        EXPECT_EQ(image.at(static_cast<int>(at.x), static_cast<int>(at.y)), palette(db / 50)) << db;
    }
}

TEST(PolarPicture, flattens_a_fall_of_30_log_r_by_its_display_gain) {
    Style style = plain();
    style.spreading = 30;
    style.absorption = 0.1;
    const Echogram ping = fan(60, 64, 50, [](double r, double) {
        return static_cast<float>(std::pow(10.0, 2.5 - 3 * std::log10(r) - 0.02 * r));
    });
    const Image image = polar_picture({&ping, 1}, style);
    for (const double range : {6.0, 13.0, 33.0, 47.0}) {
        const Place at = expected({&ping, 1}, range, deg_to_rad(7.3));
        EXPECT_NEAR(brightness(image.at(static_cast<int>(at.x), static_cast<int>(at.y))),
                    brightness(palette(0.5)), 4)
            << range;
    }
}

TEST(PolarPicture, has_no_gap_between_the_steps_of_a_head) {
    const auto pings = scan(0, 358.2, 1.8, 10, [](double, double) { return 1e3F; });
    const Image image = polar_picture(pings, plain());
    const Chart chart = Chart::fit(PolarScan(pings), 1000);
    const int level = brightness(palette(0.6)) - 3;  // each channel of the grid is rounded
    for (int y = chart.top; y < chart.bottom; ++y)
        for (int x = chart.left; x < chart.right; ++x)
            if (std::hypot(x + 0.5 - chart.center_x, y + 0.5 - chart.center_y) < 9.95 * chart.scale) {
                ASSERT_GE(brightness(image.at(x, y)), level) << x << ' ' << y;
            }
}

TEST(PolarPicture, leaves_what_no_beam_looked_at_as_background) {
    auto pings = scan(-60, -20, 2, 10, [](double, double) { return 1e3F; });
    const auto more = scan(20, 60, 2, 10, [](double, double) { return 1e3F; });
    pings.insert(pings.end(), more.begin(), more.end());
    const Image image = polar_picture(pings, plain());
    const Place gap = expected(pings, 7, 0.05), beam = expected(pings, 7, deg_to_rad(-33));
    EXPECT_EQ(image.at(static_cast<int>(gap.x), static_cast<int>(gap.y)), background);
    EXPECT_EQ(image.at(static_cast<int>(beam.x), static_cast<int>(beam.y)), palette(0.6));
}

TEST(PolarPicture, draws_the_papers_rule_from_0_to_1) {
    Echogram ping = fan(60, 64, 50, [](double, double) { return 0.25F; });
    ping.rule = EchoRule::cerqueira2016;
    const Image image = polar_picture({&ping, 1}, {});
    const Place at = expected({&ping, 1}, 33, deg_to_rad(7.3));
    EXPECT_EQ(image.at(static_cast<int>(at.x), static_cast<int>(at.y)), palette(0.25));
}

TEST(PolarPicture, draws_values_that_are_no_numbers_as_silence) {
    for (const float odd : {std::numeric_limits<float>::quiet_NaN(), -1.0F, 0.0F}) {
        const Echogram ping = fan(60, 64, 50, [=](double, double) { return odd; });
        const Image image = polar_picture({&ping, 1}, {});
        const Place at = expected({&ping, 1}, 33, deg_to_rad(7.3));
        EXPECT_EQ(image.at(static_cast<int>(at.x), static_cast<int>(at.y)), palette(0));
    }
}

TEST(PolarPicture, refuses_what_cannot_be_drawn) {
    Echogram ping = fan(60, 4, 50, [](double, double) { return 1.0F; });
    EXPECT_THROW(polar_picture({}, {}), std::invalid_argument);
    Style style;
    style.width = 100;
    EXPECT_THROW(polar_picture({&ping, 1}, style), std::invalid_argument);
    ping.values.pop_back();
    EXPECT_THROW(polar_picture({&ping, 1}, {}), std::invalid_argument);
    ping = fan(60, 4, 50, [](double, double) { return 1.0F; });
    std::vector<Echogram> mixed{ping, ping};
    mixed[1].rule = EchoRule::cerqueira2016;
    EXPECT_THROW(polar_picture(mixed, {}), std::invalid_argument);
    for (double* member : {&ping.shot.bin_interval, &ping.shot.pan, &ping.shot.bearings[1], &ping.sound_speed,
                           &ping.shot.first_bin_time, &ping.shot.beam_width}) {
        const double before = *member;
        for (const double odd : {std::nan(""), HUGE_VAL}) {
            *member = odd;
            EXPECT_THROW(polar_picture({&ping, 1}, {}), std::invalid_argument);
        }
        *member = before;
        EXPECT_NO_THROW(polar_picture({&ping, 1}, {}));
    }
}

TEST(PolarScan, keeps_a_sector_across_the_stern_in_one_piece) {
    const auto pings = scan(150, 210, 3, 10, [](double, double) { return 1.0F; });
    const PolarScan polar(pings);
    EXPECT_FALSE(polar.full_turn());
    EXPECT_NEAR(rad_to_deg(polar.end() - polar.begin()), 63, 1e-9);
    EXPECT_TRUE(polar.covers(deg_to_rad(-179)));
    EXPECT_FALSE(polar.covers(0));
}

TEST(PolarScan, lets_a_later_ping_replace_an_earlier_one) {
    auto pings = scan(0, 90, 1.8, 10, [](double, double) { return 1.0F; });
    const auto later = scan(0, 90, 1.8, 10, [](double, double) { return 7.0F; });
    pings.insert(pings.end(), later.begin(), later.end());
    EXPECT_DOUBLE_EQ(PolarScan(pings).value(5, deg_to_rad(30)), 7);
}

TEST(PolarScan, is_linear_between_beams_and_between_bins) {
    const auto pings = scan(0, 10, 2, 10, [](double r, double b) { return static_cast<float>(r + 100 * b); });
    const PolarScan polar(pings);
    EXPECT_NEAR(polar.value(4.321, deg_to_rad(5.3)), 4.321 + 100 * deg_to_rad(5.3), 1e-5);
    EXPECT_EQ(polar.value(10.2, deg_to_rad(5)), 0) << "outside the window";
}

TEST(PolarScan, keeps_the_power_of_bins_finer_than_a_pixel) {
    const auto field = [](double r, double) { return std::abs(r - 4.995) < 0.003 ? 1000.0F : 0.0F; };
    const Echogram ping = test::ping({-0.1, 0.1}, 0, 0.2, 10, 1000, field);  // 1 cm bins, one of them loud
    const PolarScan polar({&ping, 1});
    double sum = 0;
    for (double r = 0.05; r < 10; r += 0.1) sum += polar.value(r, 0, 0.1) * 0.1;
    EXPECT_NEAR(sum, 1000 * 0.01, 0.01);
    EXPECT_NEAR(polar.value(4.996, 0, 0.05), 1000 * 0.01 / 0.05, 1);
}

TEST(RoundStep, is_1_2_or_5_times_a_power_of_ten) {
    EXPECT_DOUBLE_EQ(round_step(50, 5), 10);
    EXPECT_DOUBLE_EQ(round_step(20, 5), 5);
    EXPECT_DOUBLE_EQ(round_step(0.9, 5), 0.2);
    EXPECT_DOUBLE_EQ(round_step(1200, 5), 200);
}

TEST(Ticks, are_the_multiples_of_a_step_with_both_ends) {
    EXPECT_EQ(ticks(-1, 1, 0.5), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
    EXPECT_EQ(ticks(0.3, 2.9, 1), (std::vector<double>{1, 2}));
    EXPECT_EQ(ticks(0, 0.3, 0.1).size(), 4) << "3 x 0.1 is a little more than 0.3";
}

/// Pings of a side-scan 1 s apart: one spot that passes at 30 m to starboard in ping 150 of 200.
std::vector<Echogram> passes(std::size_t beams) {
    std::vector<Echogram> pings;
    for (int k = 0; k < 200; ++k) {
        const bool there = std::abs(k - 150) < 4;
        const auto field = [=](double range, double bearing) {
            return there && std::abs(range - 30) < 1 && (beams == 1 || bearing > 0) ? 1e6F : 1.0F;
        };
        const double side = deg_to_rad(90);
        pings.push_back(test::ping(beams == 1 ? std::vector{0.0} : std::vector{-side, side}, 0,
                                   deg_to_rad(0.5), 50, 500, field));
    }
    return pings;
}

std::vector<double> seconds(std::size_t count) {
    std::vector<double> times(count);
    for (std::size_t i = 0; i < count; ++i) times[i] = static_cast<double>(i);
    return times;
}

/// Middle of the brightest pixels in the frame of a waterfall, as shares of its width and height.
Place brightest_share(const Image& image) {
    constexpr int left = 70, right = 150, top = 120, bottom = 60;
    const int width = image.width - left - right, height = image.height - top - bottom;
    Place sum;
    int count = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (brightness(image.at(left + x, top + y)) > 650) sum.x += x + 0.5, sum.y += y + 0.5, ++count;
    return count ? Place{sum.x / count / width, sum.y / count / height} : Place{-1, -1};
}

TEST(WaterfallPicture, shows_port_to_the_left_and_later_pings_below) {
    const auto times = seconds(200);
    const auto two = passes(2), one = passes(1);
    const Place both = brightest_share(waterfall_picture({two, times, {true, false}, false}, plain()));
    EXPECT_NEAR(both.x, 0.5 + 0.5 * 30 / 50, 0.01);
    EXPECT_NEAR(both.y, 150.5 / 200, 0.01);
    const Place port = brightest_share(waterfall_picture({one, times, {true}, false}, plain()));
    EXPECT_NEAR(port.x, 1 - 30.0 / 50, 0.01) << "range runs to the left";
    const Place starboard = brightest_share(waterfall_picture({one, times, {false}, false}, plain()));
    EXPECT_NEAR(starboard.x, 30.0 / 50, 0.01);
}

TEST(WaterfallPicture, of_an_echosounder_has_time_to_the_right_and_range_down) {
    const auto times = seconds(200);
    const auto pings = passes(1);
    const Place seen = brightest_share(waterfall_picture({pings, times, {false}, true}, plain()));
    EXPECT_NEAR(seen.x, 150.5 / 200, 0.01);
    EXPECT_NEAR(seen.y, 30.0 / 50, 0.01);
}

TEST(WaterfallPicture, refuses_what_it_cannot_draw) {
    const auto times = seconds(200);
    const auto two = passes(2), one = passes(1);
    const std::vector<double> few(3);
    EXPECT_THROW(waterfall_picture({two, times, {true, true}, false}, plain()), std::invalid_argument);
    EXPECT_THROW(waterfall_picture({two, times, {true}, false}, plain()), std::invalid_argument);
    EXPECT_THROW(waterfall_picture({one, few, {true}, false}, plain()), std::invalid_argument);
    EXPECT_THROW(waterfall_picture({{}, {}, {true}, false}, plain()), std::invalid_argument);
}

}  // namespace
}  // namespace echoloop::draw
