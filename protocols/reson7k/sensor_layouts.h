// Field tables of the records of the sensors around a 7k sonar. Tables only.
#pragma once

#include "protocols/reson7k/sensors.h"
#include "protocols/wire/layout.h"

namespace echoloop::reson7k {

constexpr auto wire_layout(wire::Tag<Position>) {
    using wire::field;
    using P = Position;
    return wire::make_layout<P>(
        {"Position", "1003, five times a second"}, field(&P::datum, "datum", "", "0: WGS 84"),
        field(&P::latency, "latency", "s", ""), field(&P::latitude, "latitude", "rad", ""),
        field(&P::longitude, "longitude", "rad", ""), field(&P::height, "height", "m", "above the ellipsoid"),
        field(&P::kind, "kind", "", "0: geographic"), field(&P::zone, "zone", "", "of a grid"),
        field(&P::quality, "quality", "", ""),
        field(&P::method, "method", "", "0 GPS, 1 DGPS, 15 RTK fixed, 16 RTK float"),
        field(&P::satellites, "satellites", "", ""));
}
constexpr auto wire_layout(wire::Tag<RollPitchHeave>) {
    using wire::field;
    using R = RollPitchHeave;
    return wire::make_layout<R>(
        {"RollPitchHeave", "1012, 50 times a second"}, field(&R::roll, "roll", "rad", "positive: port up"),
        field(&R::pitch, "pitch", "rad", "positive: bow up"), field(&R::heave, "heave", "m", "positive: up"));
}
constexpr auto wire_layout(wire::Tag<ShipHeading>) {
    return wire::make_layout<ShipHeading>(
        {"ShipHeading", "1013, 50 times a second"},
        wire::field(&ShipHeading::heading, "heading", "rad", "clockwise from north"));
}
constexpr auto wire_layout(wire::Tag<AttitudeSample>) {
    using wire::field;
    using A = AttitudeSample;
    return wire::make_layout<A>({"AttitudeSample", "of 1016"},
                                field(&A::milliseconds, "milliseconds", "ms", "after the record's time"),
                                field(&A::roll, "roll", "rad", "positive: port up"),
                                field(&A::pitch, "pitch", "rad", "positive: bow up"),
                                field(&A::heave, "heave", "m", "positive: up"),
                                field(&A::heading, "heading", "rad", "clockwise from north"));
}
constexpr auto wire_layout(wire::Tag<Attitude>) {
    using A = Attitude;
    return wire::make_layout<A>({"Attitude", "1016, five times a second with ten samples"},
                                wire::count(&A::count, "samples", "count", "", ""),
                                wire::counted(&A::samples, "samples", "samples", "", ""));
}
constexpr auto wire_layout(wire::Tag<SoundSpeed>) {
    using S = SoundSpeed;
    return wire::make_layout<S>({"SoundSpeed", "7610, at a subscription, at a change and every ten seconds"},
                                wire::field(&S::speed, "speed", "m/s", ""),
                                wire::rest(&S::more, {}, "more", "", "nothing, or f32 K and f32 Pa"));
}

}  // namespace echoloop::reson7k
