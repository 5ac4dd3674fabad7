// The searches for paths of one ping: to targets, straight back from flat faces, off diffuse surfaces by way
// of a mirror, and into corners. Each adds to a list and has a bounded cost.
#pragma once

#include <span>
#include <vector>

#include "render/paths/corners.h"
#include "render/paths/lobe_cells.h"
#include "render/paths/mirrors.h"
#include "render/paths/path_ping.h"

namespace echoloop {

/// Echoes of targets of declared strength; the direct ones only, unless `multipath`. Power SL + TS with the
/// spreading and absorption of both ways, a reflection -1 times the roughness loss at the surface, and that
/// of the material elsewhere. Ways by triangles are looked for at the first 32 targets in reach.
void find_target_echoes(const PathPing& ping, std::span<const PointTarget> targets, bool multipath,
                        std::vector<TargetEcho>& out);

/// The coherent echoes of those flat `faces` that the sonar is in front of: its image behind each (Urick,
/// Principles of Underwater Sound, 1983, chapter 9),
///     power = SL bt^2 br^2 (V F)^2 e^-G e^(-4aR) / (2R)^2
/// at the distance R of the plane, from the direction of the perpendicular's foot; G = (2 k h)^2 for the rms
/// height h, F as Mirrors::foot() has it. Where the foot lies beside the face, the edge's wave is heard from
/// the edge. The 32 loudest, as far as a ray sees the foot.
void find_glints(const PathPing& ping, const Mirrors& mirrors, std::span<const std::size_t> faces,
                 std::vector<TargetEcho>& out);

/// The faces whose perpendicular through the sonar meets them, or near enough for their edges, and that can
/// be heard if nothing is in between and the pattern is 1.
std::vector<std::size_t> faces_ahead(const PathPing& ping, const Mirrors& mirrors);

/// The sonar's images in two to five mirrors, of the 16 loudest among `faces` and the water's surface (Allen
/// & Berkley, JASA 65 (1979) 943): a path of the length 2R' comes back with
///     power = SL bt^2 br'^2 (V1 F1 .. Vn Fn)^2 e^-(G1 + .. + Gn) e^(-4aR') / (2R')^2,
/// with the patterns where it leaves and where it arrives. What roughness takes from it comes back as
/// diffuse power (chains.h). Right angles are left to find_corner_echoes(). The 64 loudest that can be heard,
/// each with a ray for every leg. A curved mesh below counts as a level plane without a coherent echo.
void find_image_echoes(const PathPing& ping, const Mirrors& mirrors, std::span<const std::size_t> faces,
                       std::vector<TargetEcho>& targets, std::vector<PathEcho>& diffuse);

/// Diffuse echoes by way of one mirror (the surface, or smooth triangles). The rays of `cells` fill the main
/// lobe of the fan evenly, each stands for its solid angle dw:
///   - where it meets a mirror first, and the point P of Lambert's constant mu after it at the path length L,
///   the echo
///     back by the same way is SL V^4 bt^2 br^2 mu cos(i) dw L^-2 e^(-4aL), and, with P in sight at the range
///     R, that there and back by different ways SL V^2 (bt br' + bt' br)^2 mu cos(i') dw R^-2 e^(-2a(L+R));
///   - where it meets P first, and the surface way to P leaves outside the main lobe, the same two.
/// Corners that come into sight are added to `corners`.
void find_diffuse_echoes(const PathPing& ping, const LobeCells& cells, std::vector<PathEcho>& out,
                         std::vector<Corner>& corners);

/// Echoes of corners, as mirrors see the sonar's image behind their edge at twice the range R:
///     power = SL bt^2 br^2 (V1 V2 .. f)^2 / (2R)^2, f the share of the zone that sends sound back.
/// The zone is a disc of the area lambda R / 2 about the corner, the effective part of a mirror's Fresnel
/// zones; so a small corner of the effective area A has a target strength of 20 log10(A / lambda), and a
/// large one that of a mirror, 20 log10(R / 2) (Urick, Principles of Underwater Sound, 1983, table 9.1).
void find_corner_echoes(const PathPing& ping, std::span<const Corner> corners, std::vector<TargetEcho>& out);

}  // namespace echoloop
