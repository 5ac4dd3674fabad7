// What a multibeam makes of all detections of a ping together.
#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "emulator/devices/family/multibeam/bottom.h"

namespace echoloop::test {
namespace {

using multibeam::Detection;
using multibeam::Method;

/// A flat floor, 14 m below, as 20 beams of 1 deg from -70 deg on hear it by phase; the two outermost on
/// either side are 1 % off.
struct FlatSwath {
    std::vector<Detection> detections;
    std::vector<double> angles;
    std::size_t used = 20;  ///< of them; the others lie behind in memory

    FlatSwath() {
        for (int beam = 0; beam < 20; ++beam) {
            angles.push_back(deg_to_rad(-70 + beam));
            Detection heard;
            heard.method = Method::phase;
            heard.time = right(angles.size() - 1) * (beam < 2 || beam >= 18 ? 1.01 : 1);
            heard.begin = 0.9 * heard.time;
            heard.end = 1.1 * heard.time;
            detections.push_back(heard);
        }
    }

    double right(std::size_t beam) const { return 14 / 750.0 / std::cos(angles[beam]); }
    double error_now(std::size_t beam) const { return std::abs(detections[beam].time / right(beam) - 1); }
    /// How far a beam is off, after continue_to_edges() with beams of 3 deg.
    double error(std::size_t beam) {
        auto continued = detections;
        multibeam::continue_to_edges(std::span(continued).first(used), angles, deg_to_rad(3));
        return std::abs(continued[beam].time / right(beam) - 1);
    }
};

TEST(MultibeamEdges, GoOnInTheLineOfTheBeamsInside) {
    FlatSwath swath;
    for (const std::size_t edge : {0U, 1U, 18U, 19U}) EXPECT_LT(swath.error(edge), 1e-9) << edge;
    swath.detections[3].time *= 1.001;
    EXPECT_NEAR(swath.error(3), 0.001, 1e-9) << "no edge: it stays as it was heard";
}

TEST(MultibeamEdges, StayWhereTheirEchoDoesNotMeetTheLine) {
    FlatSwath swath;
    swath.detections[0].end = 0.999 * swath.right(0);
    swath.detections[19].begin = 1.001 * swath.right(19);
    for (const std::size_t edge : {0U, 19U}) EXPECT_NEAR(swath.error(edge), 0.01, 1e-9) << edge;
    for (const std::size_t edge : {1U, 18U}) EXPECT_LT(swath.error(edge), 1e-9) << edge;
}

TEST(MultibeamEdges, StayWhereTheyOrABeamInsideWereNotHeardByPhase) {
    FlatSwath swath;
    swath.detections[0].method = Method::magnitude;
    swath.detections[14].method = Method::magnitude;
    EXPECT_NEAR(swath.error(0), 0.01, 1e-9);
    EXPECT_LT(swath.error(1), 1e-9);
    for (const std::size_t edge : {18U, 19U}) EXPECT_NEAR(swath.error(edge), 0.01, 1e-9) << "no line";
}

TEST(MultibeamEdges, StayWhereThereAreTooFewBeamsForALine) {
    FlatSwath swath;
    for (const std::size_t used : {0U, 1U, 2U, 7U}) {
        swath.used = used;
        for (const std::size_t edge : {0U, 1U}) EXPECT_NEAR(swath.error(edge), 0.01, 1e-9) << used;
    }
    swath.used = 8;
    EXPECT_LT(swath.error(0), 1e-9);
}

/// How far beam 10 of the flat swath is off after it was moved to its neighbours.
double moved(const FlatSwath& swath, double beam_width_deg = 1) {
    auto detections = swath.detections;
    multibeam::move_to_neighbours(detections, swath.angles, deg_to_rad(beam_width_deg));
    for (const std::size_t other : {5U, 9U, 11U, 14U})
        EXPECT_EQ(detections[other].time, swath.detections[other].time) << other;
    return std::abs(detections[10].time / swath.right(10) - 1);
}

TEST(MultibeamNeighbours, BringBackABeamThatSpeckleMoved) {
    FlatSwath swath;
    swath.detections[10].time *= 1.006;
    EXPECT_LT(moved(swath), 1e-9);
    EXPECT_NEAR(moved(swath, 2.5), 0.006, 1e-9) << "beams that overlap share what moved them";
}

TEST(MultibeamNeighbours, LeaveWhatIsReallyThere) {
    FlatSwath near, thing, step, hole;
    near.detections[10].time *= 1.0025;
    EXPECT_NEAR(moved(near), 0.0025, 1e-9) << "a scatter as any";
    thing.detections[10].time *= 0.98, thing.detections[10].end = 0.99 * thing.right(10);
    EXPECT_NEAR(moved(thing), 0.02, 1e-9) << "nothing was heard where the floor is";
    for (std::size_t beam = 10; beam < 20; ++beam) step.detections[beam].time *= 0.97;
    EXPECT_NEAR(moved(step), 0.03, 1e-9) << "the neighbours are on no line";
    hole.detections[10].time *= 1.006, hole.detections[8].method = Method::none;
    EXPECT_NEAR(moved(hole), 0.006, 1e-9);
}

/// Standard deviation of the times of the beams by phase, as a part of their time, after smoothing over so
/// many.
double scatter(FlatSwath swath, std::size_t beams) {
    multibeam::smooth_by_phase(swath.detections, swath.angles, beams);
    double squares = 0;
    for (std::size_t beam = 4; beam < 16; ++beam) squares += std::pow(swath.error_now(beam), 2) / 12;
    return std::sqrt(squares);
}

TEST(MultibeamSmoothing, AveragesSoManySoundingsByPhase) {
    FlatSwath swath;
    for (std::size_t beam = 0; beam < 20; ++beam)
        swath.detections[beam].time = swath.right(beam) * (1 + (beam % 2 == 0 ? 1e-3 : -1e-3));
    EXPECT_NEAR(scatter(swath, 1), 1e-3, 1e-9) << "one: none";
    EXPECT_NEAR(scatter(swath, 3), 1e-3 / 3, 2e-5) << "two against one of three";
    EXPECT_NEAR(scatter(swath, 5), 1e-3 / 5, 2e-5);
}

TEST(MultibeamSmoothing, BeginsWhereAmplitudeIsFarAway) {
    FlatSwath swath;
    for (std::size_t beam = 0; beam < 20; ++beam)
        swath.detections[beam].time = swath.right(beam) * (1 + (beam % 2 == 0 ? 1e-3 : -1e-3));
    swath.detections[2].method = Method::magnitude;
    multibeam::smooth_by_phase(swath.detections, swath.angles, 5);
    for (const std::size_t beam : {4U, 8U, 12U}) EXPECT_NEAR(swath.error_now(beam), 1e-3, 1e-9) << beam;
    for (const std::size_t beam : {13U, 17U}) EXPECT_LT(swath.error_now(beam), 4e-4) << beam;
}

TEST(MultibeamSmoothing, LeavesWhatIsReallyThereAndWhatWasHeardByMagnitude) {
    FlatSwath swath;
    for (std::size_t beam = 0; beam < 20; ++beam) swath.detections[beam].time = swath.right(beam);
    swath.detections[10].time *= 1.006;  // a stone
    swath.detections[5].method = Method::magnitude;
    swath.detections[5].time *= 1.001;
    multibeam::smooth_by_phase(swath.detections, swath.angles, 5);
    EXPECT_NEAR(swath.error_now(10), 0.006, 1e-9);
    EXPECT_NEAR(swath.error_now(5), 0.001, 1e-9);
    for (const std::size_t beam : {4U, 6U, 9U, 11U}) EXPECT_LT(swath.error_now(beam), 1e-9) << beam;
}

TEST(MultibeamLine, PointsOffTheLineOfTheirNeighboursAreNotMarked) {
    std::vector<Detection> points(9);
    std::vector<double> angles;
    for (int n = 0; n < 9; ++n) {
        angles.push_back(deg_to_rad(-20 + 5 * n));
        points[static_cast<std::size_t>(n)].time = 0.02 / std::cos(angles.back());
        points[static_cast<std::size_t>(n)].method = Method::magnitude;
    }
    points[4].time *= 1.1;
    points[8].method = Method::none;
    multibeam::mark_in_line(points, angles);
    const std::vector<bool> expected{true, true, true, true, false, true, true, true, false};
    for (std::size_t n = 0; n < 9; ++n) EXPECT_EQ(points[n].in_line, expected[n]) << n;
}

}  // namespace
}  // namespace echoloop::test
