// Names of the values and bits in 7k records. Names only.
#pragma once

#include "protocols/reson7k/messages.h"
#include "protocols/wire/field.h"

namespace echoloop::reson7k {

inline constexpr wire::NamedValue error_names[] = {
    {0x7000, "not ready"},         {0x7001, "out of range"}, {0x7002, "no such record"},
    {0x7007, "unknown command"},   {0x7008, "invalid"},      {0x7009, "bad device"},
    {0x700A, "subscription only"}, {0x700B, "clipped"},      {0x700C, "denied"},
};
inline constexpr wire::NamedValue record_flag_names[] = {{1, "checksum"}, {0x8000, "recorded"}};
inline constexpr wire::NamedValue control_names[] = {
    {1U << 8, "range filter"}, {1U << 9, "depth filter"}, {1U << 15, "active"}, {1U << 31, "simulator"}};
inline constexpr wire::NamedValue water_column_names[] = {
    {1, "to bottom"},           {2, "no phase"},      {4, "in bytes"},
    {1U << 12, "32 bits"},      {1U << 13, "factor"}, {1U << 14, "segments"},
    {1U << 15, "receive delay"}};
inline constexpr wire::NamedValue detection_names[] = {{1, "magnitude"}, {2, "phase"}, {4, "quality type 1"}};
inline constexpr wire::NamedValue quality_names[] = {{1, "bright"}, {2, "in line"}};

}  // namespace echoloop::reson7k

namespace echoloop::wire {

template <>
inline constexpr std::span<const NamedValue> value_names<reson7k::ErrorCode> = reson7k::error_names;

}  // namespace echoloop::wire
