// Names of the values and bits in the packets of a Norbit WBMS. Names only.
#pragma once

#include "protocols/norbit/messages.h"
#include "protocols/wire/field.h"

namespace echoloop::norbit {

inline constexpr wire::NamedValue type_names[] = {
    {1, "Bathymetry"}, {2, "WaterColumn"}, {4, "Snippet"}, {5, "SideScan"}};
inline constexpr wire::NamedValue beam_mode_names[] = {
    {1, "512EA"}, {2, "256EA"}, {3, "256ED"}, {4, "512EAx"}, {5, "256EAx"}};
inline constexpr wire::NamedValue sonar_mode_names[] = {{0, "FLS"},       {1, "bathymetry"},
                                                        {2, "amplitude"}, {4, "pass-through"},
                                                        {5, "edge"},      {6, "super-resolution"}};
inline constexpr wire::NamedValue sample_names[] = {{0, "u8"},     {1, "s8"},    {2, "u16"}, {3, "s16"},
                                                    {4, "u32"},    {5, "s32"},   {6, "u64"}, {7, "s64"},
                                                    {0x15, "f32"}, {0x17, "f64"}};
inline constexpr wire::NamedValue quality_names[] = {{snr_good, "SNR"}, {colinear, "colinear"}};
inline constexpr wire::NamedValue flag_names[] = {{by_magnitude, "magnitude"}, {by_phase, "phase"}};

}  // namespace echoloop::norbit

namespace echoloop::wire {

template <>
inline constexpr std::span<const NamedValue> value_names<norbit::Type> = norbit::type_names;
template <>
inline constexpr std::span<const NamedValue> value_names<norbit::BeamMode> = norbit::beam_mode_names;
template <>
inline constexpr std::span<const NamedValue> value_names<norbit::SonarMode> = norbit::sonar_mode_names;
template <>
inline constexpr std::span<const NamedValue> value_names<norbit::Sample> = norbit::sample_names;

}  // namespace echoloop::wire
