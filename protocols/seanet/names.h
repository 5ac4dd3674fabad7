// The names of SeaNet's ids and flag bits, for people. Tables only.
#pragma once

#include "protocols/seanet/constants.h"
#include "protocols/wire/field.h"

namespace echoloop::seanet {

inline constexpr wire::NamedValue id_names[] = {{0, "Null"},
                                                {1, "VersionData"},
                                                {2, "HeadData"},
                                                {3, "SpectData"},
                                                {4, "Alive"},
                                                {5, "PrgAck"},
                                                {6, "BBUserData"},
                                                {7, "TestData"},
                                                {8, "AuxData"},
                                                {9, "AdcData"},
                                                {10, "AdcReq"},
                                                {13, "LanStatus"},
                                                {14, "SetTime"},
                                                {15, "Timeout"},
                                                {16, "ReBoot"},
                                                {17, "PerformanceData"},
                                                {19, "HeadCommand"},
                                                {20, "EraseSector"},
                                                {21, "ProgBlock"},
                                                {22, "CopyBootBlk"},
                                                {23, "SendVersion"},
                                                {24, "SendBBUser"},
                                                {25, "SendData"},
                                                {26, "SendPerformanceData"},
                                                {40, "FpgaTest"},
                                                {56, "SendFpgaVersion"},
                                                {57, "FpgaVersionData"},
                                                {61, "FpgaDoCalibrate"},
                                                {62, "SendFpgaCalData"},
                                                {63, "FpgaCalData"},
                                                {64, "ZeroFpgaCal"},
                                                {66, "StopAlives"},
                                                {70, "ResetToDefaults"},
                                                {71, "ChangeVerData"},
                                                {72, "FpgaProgUsrCode"}};

inline constexpr wire::NamedValue head_command_type_names[] = {
    {0x01, "normal"}, {0x0F, "reverse"}, {0x1D, "dual"}, {0x1E, "gain"}};

inline constexpr wire::NamedValue sweep_code_names[] = {
    {0, "normal"}, {1, "at left limit"}, {2, "at right limit"}, {5, "at centre"}};

inline constexpr wire::NamedValue head_inf_names[] = {
    {head_inf::in_centre, "InCentre"}, {head_inf::centred, "Centred"}, {head_inf::motoring, "Motoring"},
    {head_inf::motor_on, "MotorOn"},   {head_inf::dir, "Dir"},         {head_inf::in_scan, "InScan"},
    {head_inf::no_params, "NoParams"}, {head_inf::sent_cfg, "SentCfg"}};

inline constexpr wire::NamedValue hd_ctrl_names[] = {{hd_ctrl::adc8on, "adc8on"},
                                                     {hd_ctrl::cont, "cont"},
                                                     {hd_ctrl::scanright, "scanright"},
                                                     {hd_ctrl::invert, "invert"},
                                                     {hd_ctrl::motoff, "motoff"},
                                                     {hd_ctrl::txoff, "txoff"},
                                                     {hd_ctrl::spare, "spare"},
                                                     {hd_ctrl::chan2, "chan2"},
                                                     {hd_ctrl::raw, "raw"},
                                                     {hd_ctrl::hasmot, "hasmot"},
                                                     {hd_ctrl::applyoffset, "applyoffset"},
                                                     {hd_ctrl::pingpong, "pingpong"},
                                                     {hd_ctrl::stare_llim, "stareLLim"},
                                                     {hd_ctrl::reply_asl, "ReplyASL"},
                                                     {hd_ctrl::reply_thr, "ReplyThr"},
                                                     {hd_ctrl::ignore_sensor, "IgnoreSensor"}};

inline constexpr wire::NamedValue profiler_ctrl_names[] = {{profiler_ctrl::agc, "AGC"},
                                                           {profiler_ctrl::alt, "alt"},
                                                           {profiler_ctrl::scanright, "scanright"},
                                                           {profiler_ctrl::invert, "invert"},
                                                           {profiler_ctrl::motoff, "motoff"},
                                                           {profiler_ctrl::txoff, "txoff"},
                                                           {profiler_ctrl::t10, "t10"},
                                                           {profiler_ctrl::chan2, "chan2"},
                                                           {profiler_ctrl::first, "first"},
                                                           {profiler_ctrl::hasmot, "hasmot"},
                                                           {profiler_ctrl::pingsync, "pingsync"},
                                                           {profiler_ctrl::scansync, "scansync"},
                                                           {profiler_ctrl::stare_llim, "stareLLim"},
                                                           {profiler_ctrl::master, "master"},
                                                           {profiler_ctrl::mirror, "mirror"},
                                                           {profiler_ctrl::ignore_sensor, "IgnoreSensor"}};

inline constexpr wire::NamedValue head_status_names[] = {{head_status::power_loss, "HdPwrLoss"},
                                                         {head_status::motor_error, "MotErr"},
                                                         {head_status::data_8bit, "8-bit"},
                                                         {head_status::message_appended, "appended"}};

}  // namespace echoloop::seanet

namespace echoloop::wire {
template <>
inline constexpr std::span<const NamedValue> value_names<seanet::Id> = seanet::id_names;
template <>
inline constexpr std::span<const NamedValue> value_names<seanet::HeadCommandType> =
    seanet::head_command_type_names;
template <>
inline constexpr std::span<const NamedValue> value_names<seanet::SweepCode> = seanet::sweep_code_names;
}  // namespace echoloop::wire
