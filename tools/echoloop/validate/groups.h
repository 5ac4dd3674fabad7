// The checks in order: V by formulas and published values, R by recordings. Each asks the parts that the
// emulator itself uses; the values to meet stand in the checks as literals.
#pragma once

#include <span>
#include <string_view>

#include "tools/echoloop/validate/findings.h"

namespace echoloop::validation {

struct Group {
    std::string_view id, title;
    void (*check)(Findings&);
};

std::span<const Group> groups();

void check_sonar_equation(Findings&);
void check_absorption(Findings&);
void check_time_base(Findings&);
void check_resolution(Findings&);
void check_beam_pattern(Findings&);
void check_target_strength(Findings&);
void check_seabed(Findings&);
void check_speckle(Findings&);
void check_noise(Findings&);
void check_gain(Findings&);
void check_shadow(Findings&);
void check_layover(Findings&);
void check_multipath(Findings&);
void check_refraction(Findings&);
void check_motion(Findings&);
void check_bookkeeping(Findings&);
void check_plane(Findings&);
void check_plates(Findings&);
void check_round_bodies(Findings&);
void check_lobe(Findings&);
void check_facets(Findings&);
void check_room(Findings&);
void check_images(Findings&);
void check_second_bottom(Findings&);
void check_volume(Findings&);
void check_sea_surface(Findings&);
void check_shared_staves(Findings&);
void check_converter(Findings&);
void check_stave_errors(Findings&);
void check_moving_speckle(Findings&);
void check_looks(Findings&);
void check_range_texture(Findings&);
void check_constant_gradient(Findings&);
void check_thermocline(Findings&);
void check_ducts(Findings&);
void check_turn_in_flight(Findings&);
void check_doppler(Findings&);
void check_detection_noise(Findings&);
void check_patches(Findings&);
void check_r2sonic(Findings&);
void check_oculus(Findings&);
void check_852(Findings&);
void check_micron(Findings&);
void check_ping360(Findings&);
void check_sonar_3d(Findings&);
void check_em2040(Findings&);

}  // namespace echoloop::validation
