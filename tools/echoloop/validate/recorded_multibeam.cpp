// R1: a Sonic 2026 under the settings of recorded pings. The vessel moves, so that the speckle is new at
// every ping.
//
// The noise of soundings is computed alike on both sides: a parabola through 11 neighbouring points of a
// ping, across and down; the distance of the middle one from it, along its beam, over its range; the standard
// deviation of that over all pings and points within 2.5 deg of an angle, over sqrt(1 - h) for what the point
// itself pulls the parabola (h: its leverage). The 100 pings' figures are the specification's; the same on 20
// pings that lie in ../shared/data gives 0.097 0.078 0.067 0.054 0.022 0.007.
#include <array>
#include <cmath>

#include "protocols/r2sonic/beams.h"
#include "tools/echoloop/validate/driven.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/statistics.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr std::array<double, 6> table_angles{5, 15, 25, 35, 45, 55};  // deg

struct Points {
    std::vector<double> angle, range, level;  ///< rad, m, dB
    std::vector<bool> by_phase;
};

Points points_of(const inspect::Message& bth0) {
    Points p;
    const double c = number_in(bth0, "h0.sound_speed"), scale = number_in(bth0, "r0.scale"),
                 step = number_in(bth0, "A2.scale");
    double angle = number_in(bth0, "A2.first");
    const auto &times = numbers_in(bth0, "r0.r"), &steps = numbers_in(bth0, "A2.step"),
               &levels = numbers_in(bth0, "i1.intensity"), &flags = numbers_in(bth0, "q0.flags");
    for (std::size_t n = 0; n < times.size() && n < steps.size() && n < levels.size(); ++n) {
        angle += step * steps[n];
        p.angle.push_back(angle);
        p.range.push_back(times[n] * scale * c / 2);
        p.level.push_back(20 * std::log10(std::max(levels[n], 1.0)));
        const auto word = static_cast<std::uint32_t>(flags.at(n / 8));
        p.by_phase.push_back(((word >> (28 - 4 * (n % 8))) & 8) != 0);
    }
    return p;
}

/// Distance of point `own` from the parabola through it and five on either side, over its range.
double off_parabola(const Points& p, std::size_t own) {
    std::array<double, 5> x{};  // sums of powers
    std::array<double, 3> y{};
    const auto across = [&](std::size_t n) { return p.range[n] * std::sin(p.angle[n]); };
    const auto down = [&](std::size_t n) { return p.range[n] * std::cos(p.angle[n]); };
    for (std::size_t n = own - 5; n <= own + 5; ++n) {
        const double dx = across(n) - across(own), dz = down(n) - down(own);
        double power = 1;
        for (std::size_t k = 0; k < 5; ++k, power *= dx) {
            x[k] += power;
            if (k < 3) y[k] += power * dz;
        }
    }
    // Cramer's rule for the constant, and the first element of the inverse.
    const double minor = x[2] * x[4] - x[3] * x[3], second = x[1] * x[4] - x[2] * x[3],
                 third = x[1] * x[3] - x[2] * x[2];
    const double all = x[0] * minor - x[1] * second + x[2] * third;
    const double constant = (y[0] * minor - y[1] * second + y[2] * third) / all, leverage = minor / all;
    return -constant * std::cos(p.angle[own]) / p.range[own] / std::sqrt(1 - leverage);
}

template <class Take>
std::vector<double> values_near(const std::vector<Points>& pings, double degrees, const Take& take) {
    std::vector<double> all;
    for (const Points& p : pings)
        for (std::size_t n = 5; n + 5 < p.angle.size(); ++n)
            if (std::abs(std::abs(rad_to_deg(p.angle[n])) - degrees) < 2.5) all.push_back(take(p, n));
    return all;
}

double noise_percent(const std::vector<Points>& pings, double degrees) {
    return 100 * std::sqrt(moments(values_near(pings, degrees, off_parabola)).variance);
}

double phase_share(const std::vector<Points>& pings, double degrees) {
    double count = 0, sum = 0;
    for (const Points& p : pings)
        for (std::size_t n = 0; n < p.angle.size(); ++n)
            if (std::abs(std::abs(rad_to_deg(p.angle[n])) - degrees) < 1) ++count, sum += p.by_phase[n];
    return sum / count;
}

/// How a figure of each point correlates with itself so many pings later.
template <class Take>
double over_pings(const std::vector<Points>& pings, std::size_t lag, const Take& take) {
    std::vector<double> here, there;
    for (std::size_t ping = 0; ping + lag < pings.size(); ++ping)
        for (std::size_t n = 5; n + 5 < pings[ping].angle.size(); ++n) {
            here.push_back(take(pings[ping], n));
            there.push_back(take(pings[ping + lag], n));
        }
    return correlation(here, there);
}

/// Levels less each point's own mean over the pings.
std::vector<Points> about_mean_level(std::vector<Points> pings) {
    for (std::size_t n = 0; n < pings.front().level.size(); ++n) {
        double mean = 0;
        for (const Points& p : pings) mean += p.level[n] / static_cast<double>(pings.size());
        for (Points& p : pings) p.level[n] -= mean;
    }
    return pings;
}

double own_level(const Points& p, std::size_t n) { return p.level[n]; }

double levels_over_pings(const std::vector<Points>& pings, std::size_t lag) {
    return over_pings(about_mean_level(pings), lag, own_level);
}

double level_std(const std::vector<Points>& pings, double degrees) {
    const auto off = values_near(about_mean_level(pings), degrees, own_level);
    const auto n = static_cast<double>(pings.size());
    return std::sqrt(moments(off).variance * n / (n - 1));
}

std::vector<inspect::Message> our_pings(std::size_t count) {
    // m, m/s; with that speed intensities change from ping to ping as recorded.
    const double depth = 10.75, speed = 1;
    Setup setup;
    setup.model = "r2sonic-2026";
    setup.options = {{"range", 31.948},       {"power", 206.0},
                     {"pulse", 35e-6},        {"gain", 11.0},
                     {"spreading", 15.0},     {"absorption", 81.0},
                     {"sector_width", 125.0}, {"bottom_mode", std::string("equi-distant")},
                     {"intensity", true}};
    // DGO0: gates of 30 % about the last depth, along its slope, as recorded.
    setup.asks = {{'C', 'M', 'D', '0', 'D', 'G', 'O', '0', 0, 0, 0x1E, 0x03}};
    setup.water = water_of(1514.962);
    // Residuals of the outer recorded soundings are alike from ping to ping by 0.66 and still by 0.4 after
    // five pings: 3 mm of relief, which the nadir's have too, beneath what speckle does.
    setup.scene = scene_of({rough_floor_at(-depth, 5, 25, 0.3, 0.01)});
    setup.pose = [=](double t) { return Pose{{speed * t, 0, 0}, {std::sqrt(0.5), 0, std::sqrt(0.5), 0}}; };
    Driven sonar(setup);
    std::vector<inspect::Message> pings;
    for (std::size_t ping = 0; ping < count + 4; ++ping)
        for (auto& message : sonar.ping())
            if (message.name == "BTH0" && ping >= 4)
                pings.push_back(std::move(message));  // before, no bottom is known
    return pings;
}

std::vector<Points> all_points(const std::vector<inspect::Message>& pings) {
    std::vector<Points> all;
    for (const auto& ping : pings) all.push_back(points_of(ping));
    return all;
}

std::vector<double> all_words(const std::vector<inspect::Message>& pings, std::string_view field) {
    std::vector<double> all;
    for (const auto& ping : pings)
        for (const double word : numbers_in(ping, field)) all.push_back(word);
    return all;
}

std::string degrees_text(double degrees) { return ", " + std::to_string(static_cast<int>(degrees)) + " deg"; }

void compare_with_recording(Findings& find, const std::vector<inspect::Message>& ours) {
    const auto file = find.recordings() / "r2sonic" / "r2sonic_bth0_20.pcap";
    const auto real = recorded(file, "BTH0");
    const auto mine = all_points(ours), theirs = all_points(real);
    find.source("the same figure of " + file.filename().string() + ", 20 pings", Kind::recording);
    for (const double degrees : table_angles) {
        const double expected = noise_percent(theirs, degrees);
        find.within("noise beside the file" + degrees_text(degrees), "% of range", expected, 0.25 * expected,
                    noise_percent(mine, degrees));
    }
    find.source(file.filename().string() + ": Jensen-Shannon distance of the words", Kind::recording);
    find.at_most("distance of intensities", "", 0.25,
                 histogram_distance(all_words(ours, "i1.intensity"), all_words(real, "i1.intensity"), 25));
}

}  // namespace

void check_r2sonic(Findings& find) {
    find.aims();
    const auto pings = our_pings(40);
    const auto points = all_points(pings);
    find.source("100 pings of a Sonic 2026, 400 kHz, 35 us, 10.7 m; within 25 %", Kind::recording);
    constexpr std::array noise{0.087, 0.075, 0.071, 0.063, 0.023, 0.006};
    for (std::size_t i = 0; i < noise.size(); ++i)
        find.within("noise of soundings" + degrees_text(table_angles[i]), "% of range", noise[i],
                    0.25 * noise[i], noise_percent(points, table_angles[i]));
    find.source("the same pings", Kind::recording);
    constexpr std::array<std::pair<double, double>, 7> shares{
        {{33, 0.05}, {35, 0.21}, {37, 0.42}, {39, 0.63}, {41, 0.80}, {43, 0.94}, {45, 1.0}}};
    for (const auto& [degrees, share] : shares)
        find.within("share of phase" + degrees_text(degrees), "", share, 0.1, phase_share(points, degrees));
    find.source(
        "the same pings; in the 20 of ../shared/data 3.22 2.32 1.96 1.58 1.20 0.97, and at 35 deg 1.70 to "
        "port and 1.47 to starboard, between which ours lies",
        Kind::recording);
    constexpr std::array levels{2.9, 2.4, 2.0, 1.7, 1.4, 1.0};
    for (std::size_t i = 0; i < levels.size(); ++i)
        find.within("std of intensities" + degrees_text(table_angles[i]), "dB", levels[i], 0.1 * levels[i],
                    level_std(points, table_angles[i]));
    find.source("the same pings", Kind::recording);
    constexpr std::array means{59.0, 57.2, 55.1, 53.2, 51.6, 47.7};
    for (std::size_t i = 0; i < means.size(); ++i)
        find.within("mean intensity" + degrees_text(table_angles[i]), "dB", means[i], 2,
                    moments(values_near(points, table_angles[i], [](const Points& p, std::size_t n) {
                        return p.level[n];
                    })).mean);
    constexpr std::array<std::pair<std::size_t, double>, 2> depth_lags{{{1, 0.40}, {2, 0.21}}},
        level_lags{{{1, 0.19}, {2, 0.08}}};
    for (const auto& [lag, wanted] : depth_lags)
        find.within("depth off a parabola, correlation after " + std::to_string(lag) + " pings", "", wanted,
                    0.1, over_pings(points, lag, off_parabola));
    for (const auto& [lag, wanted] : level_lags)
        find.within("intensities, correlation after " + std::to_string(lag) + " pings", "", wanted, 0.1,
                    levels_over_pings(points, lag));
    if (!find.recordings().empty()) compare_with_recording(find, pings);
}

}  // namespace echoloop::validation
