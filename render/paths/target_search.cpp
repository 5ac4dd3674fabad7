#include <numbers>

#include "render/paths/searches.h"

namespace echoloop {
namespace {

constexpr std::size_t most_thorough = 32;

std::vector<Way> ways_to(const PathPing& ping, Vec3 target, bool multipath, bool thorough) {
    std::vector<Way> ways = direct_ways(ping, target);
    if (!multipath) return ways;
    if (const auto way = surface_way(ping, target)) ways.push_back(*way);
    if (thorough)
        for (const Way& way : scene_ways(ping, target)) ways.push_back(way);
    return ways;
}

}  // namespace

void find_target_echoes(const PathPing& ping, std::span<const PointTarget> targets, bool multipath,
                        std::vector<TargetEcho>& out) {
    std::size_t thorough = 0;
    for (const PointTarget& target : targets) {
        if (norm(target.position - ping.sonar) >= ping.end_range) continue;
        const double strength = std::pow(10, target.strength_db / 20);
        const auto ways = ways_to(ping, target.position, multipath, thorough++ < most_thorough);
        for (std::size_t i = 0; i < ways.size(); ++i)
            for (std::size_t j = i; j < ways.size(); ++j) {
                const auto add = [&](const PairEcho& echo) {
                    const double amplitude = strength * echo.amplitude;
                    const double phase =
                        2 * ping.wavenumber * echo.range + (amplitude < 0 ? std::numbers::pi : 0);
                    out.push_back({echo.range, amplitude * amplitude,
                                   std::remainder(phase, 2 * std::numbers::pi), echo.bearing,
                                   ways[i].bounces + ways[j].bounces, echo.elevation, echo.turned});
                };
                if (i == j)
                    ping.echo(ways[i], add);
                else
                    ping.echo(ways[i], ways[j], add);
            }
    }
}

}  // namespace echoloop
