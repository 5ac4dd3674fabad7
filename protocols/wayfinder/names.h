// Names of the commands and their outcomes, for people. Tables only.
#pragma once

#include "protocols/wayfinder/messages.h"
#include "protocols/wire/field.h"

namespace echoloop::wayfinder {

inline constexpr wire::NamedValue kind_names[] = {
    {3, "Command"}, {4, "Response"}, {5, "Data"}, {7, "Status"}, {8, "Spectrum"}};
inline constexpr wire::NamedValue command_names[] = {
    {0x0000000F, "stop"},         {0x00000010, "start"},
    {0x00000011, "trigger"},      {0x00000017, "factory defaults"},
    {0x10000001, "get features"}, {0x12000002, "set features"},
    {0x19000001, "get tests"},    {0x1B000002, "get spectrum"},
    {0x1D000001, "get time"},     {0x1F000002, "set time"},
    {0x22000001, "start update"}, {0x22000002, "upload"},
    {0x81000001, "get system"},   {0x81000003, "get components"},
    {0x83000002, "set system"},   {0x83000004, "set components"},
    {0x85000001, "get setup"},    {0x86000003, "set sound speed"},
    {0x87000002, "set setup"}};
inline constexpr wire::NamedValue outcome_names[] = {
    {0, "none"},   {1, "success"}, {2, "unknown"}, {3, "invalid parameter"},
    {4, "failed"}, {5, "not set"}, {6, "not got"}, {7, "not while pinging"}};
inline constexpr wire::NamedValue wrong_names[] = {{0, "none"},        {1, "baud"},  {2, "trigger"},
                                                   {3, "sound speed"}, {4, "range"}, {5, "time"}};

}  // namespace echoloop::wayfinder

namespace echoloop::wire {

template <>
inline constexpr std::span<const NamedValue> value_names<wayfinder::Kind> = wayfinder::kind_names;
template <>
inline constexpr std::span<const NamedValue> value_names<wayfinder::CommandId> = wayfinder::command_names;
template <>
inline constexpr std::span<const NamedValue> value_names<wayfinder::Outcome> = wayfinder::outcome_names;
template <>
inline constexpr std::span<const NamedValue> value_names<wayfinder::Wrong> = wayfinder::wrong_names;

}  // namespace echoloop::wire
