// The field tables of the messages of a Ping360. Tables only.
#pragma once

#include "protocols/ping/layouts.h"

namespace echoloop::ping {

using namespace wire;

constexpr auto wire_layout(Tag<Ping360SetDeviceId>) {
    return make_layout<Ping360SetDeviceId>(payload_of("Ping360SetDeviceId", "new id of a Ping360"),
                                           field(&Ping360SetDeviceId::id, "id", "", "1 to 254"),
                                           field(&Ping360SetDeviceId::reserved, "reserved", "", "0"));
}
constexpr auto wire_layout(Tag<DeviceData>) {
    return make_layout<DeviceData>(
        payload_of("DeviceData", "one ping and its settings"),
        field(&DeviceData::mode, "mode", "", "1; hosts also send 0"),
        field(&DeviceData::gain_setting, "gain_setting", "", "0 low, 1 normal, 2 high"),
        field(&DeviceData::angle, "angle", "grad", "0 to 399"),
        field(&DeviceData::transmit_duration, "transmit_duration", "us", "1 to 1000"),
        field(&DeviceData::sample_period, "sample_period", "25 ns", "two-way time of a sample, 80 to 40000"),
        field(&DeviceData::transmit_frequency, "transmit_frequency", "kHz", "500 to 1000"),
        field(&DeviceData::number_of_samples, "number_of_samples", "", "200 to 1200"),
        count<std::uint16_t>("samples", 0, "data_length", "B", "bytes of data"),
        counted(&DeviceData::data, "samples", "data", "", "echo strength, nearest first"));
}
constexpr auto wire_layout(Tag<AutoDeviceData>) {
    return make_layout<AutoDeviceData>(
        payload_of("AutoDeviceData", "one ping of an automatic scan"),
        field(&AutoDeviceData::mode, "mode", "", "1; hosts also send 0"),
        field(&AutoDeviceData::gain_setting, "gain_setting", "", "0 low, 1 normal, 2 high"),
        field(&AutoDeviceData::angle, "angle", "grad", "0 to 399"),
        field(&AutoDeviceData::transmit_duration, "transmit_duration", "us", "1 to 1000"),
        field(&AutoDeviceData::sample_period, "sample_period", "25 ns",
              "two-way time of a sample, 80 to 40000"),
        field(&AutoDeviceData::transmit_frequency, "transmit_frequency", "kHz", "500 to 1000"),
        field(&AutoDeviceData::start_angle, "start_angle", "grad", ""),
        field(&AutoDeviceData::stop_angle, "stop_angle", "grad", ""),
        field(&AutoDeviceData::num_steps, "num_steps", "grad", "between pings, 1 to 10"),
        field(&AutoDeviceData::delay, "delay", "ms", "between pings, 0 to 100"),
        field(&AutoDeviceData::number_of_samples, "number_of_samples", "", "200 to 1200"),
        count<std::uint16_t>("samples", 0, "data_length", "B", "bytes of data"),
        counted(&AutoDeviceData::data, "samples", "data", "", "echo strength, nearest first"));
}
constexpr auto wire_layout(Tag<Reset>) {
    return make_layout<Reset>(payload_of("Reset", "restart"),
                              field(&Reset::bootloader, "bootloader", "", "1: stay in the boot loader"),
                              field(&Reset::reserved, "reserved", "", "0"));
}
constexpr auto wire_layout(Tag<Transducer>) {
    return make_layout<Transducer>(
        payload_of("Transducer", "turn, and ping once; answered by DeviceData"),
        field(&Transducer::mode, "mode", "", "1; hosts also send 0"),
        field(&Transducer::gain_setting, "gain_setting", "", "0 low, 1 normal, 2 high"),
        field(&Transducer::angle, "angle", "grad", "0 to 399; 400 is 0"),
        field(&Transducer::transmit_duration, "transmit_duration", "us", "1 to 1000"),
        field(&Transducer::sample_period, "sample_period", "25 ns", "two-way time of a sample, 80 to 40000"),
        field(&Transducer::transmit_frequency, "transmit_frequency", "kHz", "500 to 1000"),
        field(&Transducer::number_of_samples, "number_of_samples", "", "200 to 1200"),
        field(&Transducer::transmit, "transmit", "", "0: turn only"),
        field(&Transducer::reserved, "reserved", "", "0"));
}
constexpr auto wire_layout(Tag<AutoTransmit>) {
    return make_layout<AutoTransmit>(
        payload_of("AutoTransmit", "scan by itself; answered by AutoDeviceData again and again"),
        field(&AutoTransmit::mode, "mode", "", "1; hosts also send 0"),
        field(&AutoTransmit::gain_setting, "gain_setting", "", "0 low, 1 normal, 2 high"),
        field(&AutoTransmit::transmit_duration, "transmit_duration", "us", "1 to 1000"),
        field(&AutoTransmit::sample_period, "sample_period", "25 ns",
              "two-way time of a sample, 80 to 40000"),
        field(&AutoTransmit::transmit_frequency, "transmit_frequency", "kHz", "500 to 1000"),
        field(&AutoTransmit::number_of_samples, "number_of_samples", "", "200 to 1200"),
        field(&AutoTransmit::start_angle, "start_angle", "grad", ""),
        field(&AutoTransmit::stop_angle, "stop_angle", "grad", ""),
        field(&AutoTransmit::num_steps, "num_steps", "grad", "between pings, 1 to 10"),
        field(&AutoTransmit::delay, "delay", "ms", "between pings, 0 to 100"));
}
constexpr auto wire_layout(Tag<MotorOff>) {
    return make_layout<MotorOff>(payload_of("MotorOff", "motor current off; ends an automatic scan"));
}

}  // namespace echoloop::ping
