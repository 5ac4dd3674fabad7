// The nadir's echo comes to all beams of a multibeam through their side lobes, at one range: a ring. No unit,
// whatever its staves, takes it for a bottom that grazing beams hear faintly, or that lies beyond the window.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "emulator/devices/family/multibeam/bottom.h"
#include "render/renderer.h"
#include "tests/emulator/devices/driver.h"
#include "tests/render/shots.h"

namespace echoloop::test {
namespace {

constexpr double floor_z = -20;  // of flat.glb
constexpr std::uint64_t units = 20;

std::shared_ptr<const Scene> sandy_floor() {
    return Scene::load(ECHOLOOP_SOURCE_DIR "/config/scenes/flat.glb");
}

/// Looks down on the floor from that height and at that angle to it, elsewhere for each ping.
Pose above(double height, double roll, std::uint64_t ping) {
    const double half = std::sqrt(0.5);
    const Quat down{half, 0, half, 0}, rolled{std::cos(roll / 2), std::sin(roll / 2), 0, 0};
    return {{0.137 * static_cast<double>(ping % 8), 0, floor_z + height}, rolled * down};
}

class NadirRing : public testing::TestWithParam<const char*> {
  protected:
    /// The model's plain ping over so many metres.
    Shot shot_over(double range) const {
        const Model& model = *find_model(GetParam());
        Shot shot = model.default_shot(make_config(model), 0, range);
        shot.pan = 0;
        shot.source_level = std::max(shot.source_level, 210.0);  // loud enough for the farthest bottom
        return shot;
    }

    /// One ping of each unit; see(unit, angle, its sounding).
    template <class See>
    void each_unit(Shot shot, double height, double roll, const See& see) const {
        Renderer renderer(sandy_floor(), water_of(1500));
        const double window = shot.first_bin_time + static_cast<double>(shot.bins) * shot.bin_interval;
        const std::vector<multibeam::TimeGate> gates(shot.bearings.size(), {shot.first_bin_time, window});
        for (std::uint64_t unit = 1; unit <= units; ++unit) {
            shot.ping = shot.errors.unit = unit;
            const auto found = multibeam::detect(renderer.render(shot, above(height, roll, unit)), gates, {});
            for (std::size_t n = 0; n < found.size(); ++n) see(unit, shot.bearings[n], found[n]);
        }
    }
};

TEST_P(NadirRing, IsNotTakenForABottomSeenAtGrazingIncidence) {
    const double height = 10, slope = deg_to_rad(15);
    std::size_t missed = 0, all = 0;
    each_unit(shot_over(50), height, slope, [&](std::uint64_t unit, double angle, const auto& found) {
        const double truth = height / std::cos(angle - slope);
        if (std::abs(angle) > deg_to_rad(60)) return;
        ++all, missed += !found.found();
        if (!found.found()) return;
        EXPECT_NEAR(found.time * 750 / truth, 1, 0.1) << rad_to_deg(angle) << " deg, unit " << unit;
    });
    std::cout << GetParam() << ": " << missed << " of " << all << " without a bottom\n";
    EXPECT_LE(missed, all / 200) << "nor is the bottom lost with it";
}

TEST_P(NadirRing, IsNotTakenForABottomBeyondTheWindow) {
    const double height = 8, range = 9;
    std::size_t rings = 0, all = 0;
    each_unit(shot_over(range), height, 0, [&](std::uint64_t, double angle, const auto& found) {
        if (height / std::cos(angle) < 1.05 * range) return;
        ++all, rings += found.found() && found.time * 750 < 1.05 * height;
    });
    std::cout << GetParam() << ": " << rings << " of " << all << " are the ring\n";
    EXPECT_LE(rings, all / 50) << "but where the line of the bottom happens to meet it";
}

INSTANTIATE_TEST_SUITE_P(Multibeams, NadirRing,
                         testing::Values("imagenex-deltat", "kongsberg-kmall", "norbit-wbms", "r2sonic-2020",
                                         "r2sonic-2024", "reson-7k", "surveyor240"),
                         [](const auto& which) {
                             std::string name = which.param;
                             std::erase(name, '-');
                             return name;
                         });

}  // namespace
}  // namespace echoloop::test
