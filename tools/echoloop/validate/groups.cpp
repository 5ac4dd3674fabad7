#include "tools/echoloop/validate/groups.h"

#include <array>

namespace echoloop::validation {

std::span<const Group> groups() {
    static constexpr auto table = std::to_array<Group>({
        {"V1", "Sonar equation", check_sonar_equation},
        {"V2", "Absorption", check_absorption},
        {"V3", "Time base", check_time_base},
        {"V4", "Range resolution", check_resolution},
        {"V5", "Beam pattern", check_beam_pattern},
        {"V6", "Target strength", check_target_strength},
        {"V7", "Seabed", check_seabed},
        {"V8", "Speckle", check_speckle},
        {"V9", "Noise", check_noise},
        {"V10", "Time-varied gain and clipping", check_gain},
        {"V11", "Shadow", check_shadow},
        {"V12", "Layover and first return", check_layover},
        {"V13", "Multipath", check_multipath},
        {"V14", "Refraction", check_refraction},
        {"V15", "Motion", check_motion},
        {"V16", "Bookkeeping", check_bookkeeping},
        {"V17", "Mirror echo of a plane", check_plane},
        {"V18", "Plates and edges", check_plates},
        {"V19", "Round bodies", check_round_bodies},
        {"V20", "Lobe of facets", check_lobe},
        {"V21", "Backscatter with facets", check_facets},
        {"V22", "A room's wall and corner", check_room},
        {"V23", "Several mirrors", check_images},
        {"V24", "Second bottom", check_second_bottom},
        {"V25", "Volume reverberation", check_volume},
        {"V26", "The surface in the wind", check_sea_surface},
        {"V27", "Beams that share staves", check_shared_staves},
        {"V28", "Converters of staves", check_converter},
        {"V29", "Side lobes of arrays whose staves differ", check_stave_errors},
        {"V30", "Speckle moves with the sonar", check_moving_speckle},
        {"V31", "Looks in a bin", check_looks},
        {"V32", "Texture over range", check_range_texture},
        {"V34", "Rays in an even gradient", check_constant_gradient},
        {"V35", "A bottom below a thermocline", check_thermocline},
        {"V36", "Ducts and the deep ocean", check_ducts},
        {"V37", "Turning within a ping", check_turn_in_flight},
        {"V38", "Doppler", check_doppler},
        {"V39", "Detection noise of a multibeam", check_detection_noise},
        {"V40", "Patchy seabed", check_patches},
        {"R1", "R2Sonic beside 100 pings of a Sonic 2026", check_r2sonic},
        {"R2", "Oculus beside a ping of an M1200d", check_oculus},
        {"R3", "Imagenex 852 beside 177 shots", check_852},
        {"R4", "Micron beside turns of two heads", check_micron},
        {"R5", "Ping360 beside 99 lines", check_ping360},
        {"R6", "Sonar 3D-15 beside three shots", check_sonar_3d},
        {"R7", "EM 2040 beside water columns", check_em2040},
    });
    return table;
}

}  // namespace echoloop::validation
