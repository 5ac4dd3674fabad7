// Names of the values and bits in EdgeTech messages. Names only.
#pragma once

#include "protocols/edgetech/messages.h"
#include "protocols/wire/field.h"

namespace echoloop::edgetech {

inline constexpr wire::NamedValue type_names[] = {
    {22, "SystemTime"},   {23, "TimeDelta"},    {25, "Shutdown"},
    {41, "Alive"},        {80, "SonarData"},    {82, "OldSideScan"},
    {83, "DataActive"},   {120, "Ping"},        {121, "PingGain"},
    {125, "Trigger"},     {128, "Range"},       {129, "Coupling"},
    {133, "PulseSelect"}, {141, "GainControl"}, {182, "SystemInformation"},
    {426, "FileTime"},    {428, "Padding"},     {2002, "NmeaText"},
    {2020, "PitchRoll"},  {2060, "Pressure"},   {2080, "DopplerLog"},
    {2090, "Situation"},  {2091, "Situation2"},
};
inline constexpr wire::NamedValue command_names[] = {{0, "set"}, {1, "get"}, {2, "reply"}, {3, "error"}};
inline constexpr wire::NamedValue format_names[] = {
    {0, "envelope"}, {1, "analytic"}, {2, "raw"}, {3, "real"}, {4, "pixel"}, {9, "analytic unmatched"}};
inline constexpr wire::NamedValue valid_names[] = {
    {1U << 0, "position"},      {1U << 1, "course"},         {1U << 2, "speed"},    {1U << 3, "heading"},
    {1U << 4, "pressure"},      {1U << 5, "pitch and roll"}, {1U << 6, "altitude"}, {1U << 8, "temperature"},
    {1U << 9, "depth"},         {1U << 10, "annotation"},    {1U << 11, "cable"},   {1U << 12, "KP"},
    {1U << 13, "interpolated"}, {1U << 14, "sound speed"}};

}  // namespace echoloop::edgetech

namespace echoloop::wire {

template <>
inline constexpr std::span<const NamedValue> value_names<edgetech::Type> = edgetech::type_names;
template <>
inline constexpr std::span<const NamedValue> value_names<edgetech::Command> = edgetech::command_names;
template <>
inline constexpr std::span<const NamedValue> value_names<edgetech::DataFormat> = edgetech::format_names;

}  // namespace echoloop::wire
