// R7: what a multibeam of the EM 2040's kind hears between and behind its bottom, as recorded in water
// columns: the ring of the nadir through the side lobes of all beams, and the texture that they share.
#include <array>
#include <cmath>
#include <string>

#include "tools/echoloop/validate/driven.h"
#include "tools/echoloop/validate/groups.h"
#include "tools/echoloop/validate/statistics.h"
#include "tools/echoloop/validate/world.h"

namespace echoloop::validation {
namespace {

constexpr double depth = 26;  // m below the head

std::vector<Echogram> our_columns(std::size_t pings) {
    Setup setup;
    setup.model = "kongsberg-kmall";
    setup.options = {{"frequency", 300e3}};
    Shot shot = plain_shot(setup, 60);
    Renderer renderer(scene_of({floor_at(-depth, 200)}), water_of(1500));
    std::vector<Echogram> all;
    for (std::size_t ping = 0; ping < pings; ++ping) {
        shot.ping = ping;
        const Vec3 place{0.37 * static_cast<double>(ping), 0.29 * static_cast<double>(ping), 0};
        all.push_back(renderer.render(shot, {place, {std::sqrt(0.5), 0, std::sqrt(0.5), 0}}));
    }
    return all;
}

/// uPa^2: mean of the beams at so many deg off the nadir on both sides, over bins whose middle lies at so
/// many depths.
double mean_power(const std::vector<Echogram>& columns, double from_deg, double to_deg, double from,
                  double to) {
    double sum = 0, count = 0;
    for (const Echogram& e : columns)
        for (std::size_t beam = 0; beam < e.beams(); ++beam) {
            const double angle = std::abs(rad_to_deg(e.shot.bearings[beam]));
            if (angle < from_deg || angle >= to_deg) continue;
            for (std::size_t bin = 0; bin < e.shot.bins; ++bin) {
                const double at = e.bin_range(bin) / depth;
                if (at >= from && at < to) sum += static_cast<double>(e.beam(beam)[bin]), ++count;
            }
        }
    return sum / count;
}

/// dB, of the beams from `first` deg to starboard on, over bins that lie below the ring.
Grid levels_behind(const Echogram& e, double first) {
    std::size_t from = 0, begin = 0, end = 0;
    while (e.shot.bearings[from] < deg_to_rad(first)) ++from;
    while (e.bin_range(begin) < 1.05 * depth) ++begin;
    for (end = begin; e.bin_range(end) < 1.25 * depth;) ++end;
    Grid grid{end - begin, {}};
    for (std::size_t beam = from; beam < e.beams(); ++beam)
        for (std::size_t bin = begin; bin < end; ++bin)
            grid.words.push_back(db(static_cast<double>(e.beam(beam)[bin])));
    return grid;
}

}  // namespace

void check_em2040(Findings& find) {
    find.aims();
    const auto columns = our_columns(8);
    // The first pulse behind the nadir's range is loudest there and in the ring.
    const double first = 1, last = 1 + 750 * columns[0].shot.pulse_length / depth;
    const double nadir = mean_power(columns, 0, 1, first, last);
    find.source("an EM 2040 at 300 kHz, 26 m; here a flat floor, mean powers; within 5 dB", Kind::recording);
    struct Ring {
        double from, to, wanted;
    };
    for (const Ring& ring : {Ring{15, 20, -25.5}, {20, 25, -30.5}, {25, 30, -30.5}, {30, 36, -34.5}})
        find.within("EM 2040 ring at " + std::to_string(static_cast<int>(ring.from)) + " to " +
                        std::to_string(static_cast<int>(ring.to)) + " deg, re nadir",
                    "dB", ring.wanted, 5, db(mean_power(columns, ring.from, ring.to, first, last) / nadir));
    find.within("below the nadir, 1.05 to 1.3 depths, re nadir", "dB", -46.5, 5,
                db(mean_power(columns, 0, 1, 1.05, 1.3) / nadir));
    find.source(
        "the same; here beams beyond 40 deg from 1.05 to 1.25 depths, levels in dB. Beams of 0.54 deg at 400 "
        "kHz would be as alike, the profile has 0.4: with wider ones soundings at grazing incidence scatter "
        "twice as far",
        Kind::recording);
    const Grid behind = levels_behind(columns[0], 40), levels = texture(behind);
    find.within("standard deviation of levels", "dB", 5.5, 0.55, std::sqrt(moments(behind.words).variance));
    constexpr std::array beams{0.72, 0.38, 0.15};
    for (std::size_t lag = 1; lag <= beams.size(); ++lag)
        find.within("levels, correlation " + std::to_string(lag) + " beams apart", "", beams[lag - 1], 0.1,
                    likeness(levels, lag, 0));
    constexpr std::array samples{0.33, -0.03};
    for (std::size_t lag = 1; lag <= samples.size(); ++lag)
        find.within("levels, correlation " + std::to_string(lag) + " samples apart", "", samples[lag - 1],
                    0.1, likeness(levels, 0, lag));
}

}  // namespace echoloop::validation
