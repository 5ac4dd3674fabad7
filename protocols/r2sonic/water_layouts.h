// The field tables of the sections of R2Sonic's water column, snippets and TruePix. Tables only; offsets
// count from the start of the section.
#pragma once

#include "protocols/r2sonic/section_layouts.h"
#include "protocols/r2sonic/water_sections.h"

namespace echoloop::r2sonic {

constexpr auto wire_layout(Tag<LongH0>) {
    return make_layout<LongH0>(
        Heading{"H0 of SNI0 and TPX0", "settings of the ping", ByteOrder::big, 4, "H0"},
        field(&LongH0::settings, "settings", "",
              "as H0; its points are snippets (SNI0) or, with the six bytes before, reserved (TPX0)"),
        field(&LongH0::more, "more", "", more_help));
}

constexpr auto wire_layout(Tag<MagnitudePhase>) {
    return make_layout<MagnitudePhase>(
        {"MagnitudePhase", "one sample of M2", ByteOrder::big},
        field(&MagnitudePhase::magnitude, "magnitude", "", "not linear in the amplitude"),
        field(&MagnitudePhase::phase, "phase", "", "angle inside the beam, not linear"));
}

/// M1 and M2 differ in their data alone.
template <class M>
constexpr auto water_column_layout(Heading heading) {
    return make_layout<M>(
        heading, field(&M::ping_number, "ping_number", "", "equals H0's"),
        field(&M::reserved8, "reserved8", "", "0"),
        field(&M::total_samples, "total_samples", "", "range samples of the ping"),
        field(&M::first_sample, "first_sample", "", "of this section"),
        count(&M::samples, "samples", "samples", "", "in this section"),
        field(&M::total_beams, "total_beams", "", "multiple of 2"),
        field(&M::first_beam, "first_beam", "", "multiple of 2"),
        count(&M::beams, "beams", "beams", "", "multiple of 2"), field(&M::reserved28, "reserved28", "", ""),
        field(&M::reserved32, "reserved32", "", ""),
        counted(&M::data, {"beams", "samples"}, "data", "", "all samples of a beam, then the next beam"));
}
constexpr auto wire_layout(Tag<M1>) {
    return water_column_layout<M1>(section_of("M1", "part of a water column, magnitude"));
}
constexpr auto wire_layout(Tag<M2>) {
    return water_column_layout<M2>(section_of("M2", "part of a water column, magnitude and phase"));
}

constexpr auto wire_layout(Tag<S1>) {
    return make_layout<S1>(section_of("S1", "snippet of one sounding"),
                           field(&S1::ping_number, "ping_number", "", "equals H0's"),
                           field(&S1::snippet, "snippet", "", "0 .. H0's snippets - 1"),
                           count(&S1::samples, "samples", "samples", "", ""),
                           field(&S1::first_sample, "first_sample", "", "from zero range"),
                           field(&S1::angle, "angle", "rad", ""),
                           field(&S1::scale_first, "scale_first", "", "0: ignore"),
                           field(&S1::scale_last, "scale_last", "", "linear between"),
                           field(&S1::reserved28, "reserved28", "", ""),
                           counted(&S1::magnitude, "samples", "magnitude", "", ""));
}

constexpr auto wire_layout(Tag<SidePair>) {
    return make_layout<SidePair>({"SidePair", "one sample of D0", ByteOrder::big},
                                 field(&SidePair::port, "port", "", "magnitude"),
                                 field(&SidePair::starboard, "starboard", "", "magnitude"));
}
constexpr auto wire_layout(Tag<D0>) {
    return make_layout<D0>(section_of("D0", "part of a TruePix ping, magnitude"),
                           field(&D0::ping_number, "ping_number", "", "equals H0's"),
                           field(&D0::total_samples, "total_samples", "", "range samples of the ping"),
                           field(&D0::first_sample, "first_sample", "", "of this section"),
                           count(&D0::samples, "samples", "samples", "", "in this section"),
                           field(&D0::reserved18, "reserved18", "", ""),
                           field(&D0::scaling, "scaling", "", "0: ignore"),
                           counted(&D0::data, "samples", "data", "", ""));
}

constexpr auto wire_layout(Tag<AngledPair>) {
    return make_layout<AngledPair>(
        {"AngledPair", "one sample of D1", ByteOrder::big}, field(&AngledPair::port, "port", "", "magnitude"),
        field(&AngledPair::port_angle, "port_angle", "angle_scale", "positive to starboard"),
        field(&AngledPair::starboard, "starboard", "", "magnitude"),
        field(&AngledPair::starboard_angle, "starboard_angle", "angle_scale", "positive to starboard"));
}
constexpr auto wire_layout(Tag<D1>) {
    return make_layout<D1>(section_of("D1", "part of a TruePix ping, magnitude and direction"),
                           field(&D1::ping_number, "ping_number", "", "equals H0's"),
                           field(&D1::total_samples, "total_samples", "", "range samples of the ping"),
                           field(&D1::first_sample, "first_sample", "", "of this section"),
                           count(&D1::samples, "samples", "samples", "", "in this section"),
                           field(&D1::reserved18, "reserved18", "", ""),
                           field(&D1::scaling, "scaling", "", "0: ignore"),
                           field(&D1::angle_scale, "angle_scale", "rad", "of one step"),
                           counted(&D1::data, "samples", "data", "", ""));
}

}  // namespace echoloop::r2sonic
