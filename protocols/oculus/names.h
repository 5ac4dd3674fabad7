// Names of the values and bits in Oculus messages. Names only.
#pragma once

#include "protocols/oculus/messages.h"
#include "protocols/wire/field.h"

namespace echoloop::oculus {

inline constexpr wire::NamedValue id_names[] = {
    {0, "Status"},        {0x15, "Fire"},    {0x22, "FullResult"}, {0x23, "Result"},
    {0x55, "UserConfig"}, {0x80, "LogText"}, {0xFF, "Dummy"},
};
inline constexpr wire::NamedValue mode_names[] = {{0, "flexi"}, {1, "low frequency"}, {2, "high frequency"}};
inline constexpr wire::NamedValue rate_names[] = {{0, "10 Hz"}, {1, "15 Hz"}, {2, "40 Hz"},
                                                  {3, "5 Hz"},  {4, "2 Hz"},  {5, "standby"}};
inline constexpr wire::NamedValue data_size_names[] = {
    {0, "8 bits"}, {1, "16 bits"}, {2, "24 bits"}, {3, "32 bits"}};
inline constexpr wire::NamedValue flag_names[] = {
    {flag::range_in_metres, "range in metres"}, {flag::data_16_bit, "16 bit"},
    {flag::gain_words, "gain words"},           {flag::simple_result, "simple result"},
    {flag::gain_assist, "gain assist"},         {flag::beams_512, "512 beams"},
};
inline constexpr wire::NamedValue ext_flag_names[] = {{flag::data_32_bit, "32 bit"}};
/// Bits 0 to 2 are the state (3: main program), 3 to 5 the reason of a pause.
inline constexpr wire::NamedValue status_bit_names[] = {
    {1U << 14, "high temperature"}, {1U << 15, "over-temperature"}, {1U << 16, "transmit circuit failure"}};

}  // namespace echoloop::oculus

namespace echoloop::wire {

template <>
inline constexpr std::span<const NamedValue> value_names<oculus::Id> = oculus::id_names;
template <>
inline constexpr std::span<const NamedValue> value_names<oculus::Mode> = oculus::mode_names;
template <>
inline constexpr std::span<const NamedValue> value_names<oculus::Rate> = oculus::rate_names;
template <>
inline constexpr std::span<const NamedValue> value_names<oculus::DataSize> = oculus::data_size_names;

}  // namespace echoloop::wire
