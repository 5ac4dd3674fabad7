// The messages of the Ping360 as plain structs. No wire code: layouts.h says how they stand on the line.
#pragma once

#include "protocols/ping/common_messages.h"

namespace echoloop::ping {

/// New id of a Ping360.
struct Ping360SetDeviceId {
    std::uint8_t id = 0;        ///< 1 to 254
    std::uint8_t reserved = 0;  ///< 0

    friend bool operator==(const Ping360SetDeviceId&, const Ping360SetDeviceId&) = default;
};
/// One ping and its settings.
struct DeviceData {
    std::uint8_t mode = 0;                 ///< 1; hosts also send 0
    std::uint8_t gain_setting = 0;         ///< 0 low, 1 normal, 2 high
    std::uint16_t angle = 0;               ///< grad; 0 to 399
    std::uint16_t transmit_duration = 0;   ///< us; 1 to 1000
    std::uint16_t sample_period = 0;       ///< 25 ns; two-way time of a sample, 80 to 40000
    std::uint16_t transmit_frequency = 0;  ///< kHz; 500 to 1000
    std::uint16_t number_of_samples = 0;   ///< 200 to 1200
    std::vector<std::uint8_t> data;        ///< echo strength, nearest first

    friend bool operator==(const DeviceData&, const DeviceData&) = default;
};
/// One ping of an automatic scan.
struct AutoDeviceData {
    std::uint8_t mode = 0;                 ///< 1; hosts also send 0
    std::uint8_t gain_setting = 0;         ///< 0 low, 1 normal, 2 high
    std::uint16_t angle = 0;               ///< grad; 0 to 399
    std::uint16_t transmit_duration = 0;   ///< us; 1 to 1000
    std::uint16_t sample_period = 0;       ///< 25 ns; two-way time of a sample, 80 to 40000
    std::uint16_t transmit_frequency = 0;  ///< kHz; 500 to 1000
    std::uint16_t start_angle = 0;         ///< grad
    std::uint16_t stop_angle = 0;          ///< grad
    std::uint8_t num_steps = 0;            ///< grad; between pings, 1 to 10
    std::uint8_t delay = 0;                ///< ms; between pings, 0 to 100
    std::uint16_t number_of_samples = 0;   ///< 200 to 1200
    std::vector<std::uint8_t> data;        ///< echo strength, nearest first

    friend bool operator==(const AutoDeviceData&, const AutoDeviceData&) = default;
};
/// Restart.
struct Reset {
    std::uint8_t bootloader = 0;  ///< 1: stay in the boot loader
    std::uint8_t reserved = 0;    ///< 0

    friend bool operator==(const Reset&, const Reset&) = default;
};
/// Turn, and ping once; answered by DeviceData.
struct Transducer {
    std::uint8_t mode = 0;                 ///< 1; hosts also send 0
    std::uint8_t gain_setting = 0;         ///< 0 low, 1 normal, 2 high
    std::uint16_t angle = 0;               ///< grad; 0 to 399; 400 is 0
    std::uint16_t transmit_duration = 0;   ///< us; 1 to 1000
    std::uint16_t sample_period = 0;       ///< 25 ns; two-way time of a sample, 80 to 40000
    std::uint16_t transmit_frequency = 0;  ///< kHz; 500 to 1000
    std::uint16_t number_of_samples = 0;   ///< 200 to 1200
    std::uint8_t transmit = 0;             ///< 0: turn only
    std::uint8_t reserved = 0;             ///< 0

    friend bool operator==(const Transducer&, const Transducer&) = default;
};
/// Scan by itself; answered by AutoDeviceData again and again.
struct AutoTransmit {
    std::uint8_t mode = 0;                 ///< 1; hosts also send 0
    std::uint8_t gain_setting = 0;         ///< 0 low, 1 normal, 2 high
    std::uint16_t transmit_duration = 0;   ///< us; 1 to 1000
    std::uint16_t sample_period = 0;       ///< 25 ns; two-way time of a sample, 80 to 40000
    std::uint16_t transmit_frequency = 0;  ///< kHz; 500 to 1000
    std::uint16_t number_of_samples = 0;   ///< 200 to 1200
    std::uint16_t start_angle = 0;         ///< grad
    std::uint16_t stop_angle = 0;          ///< grad
    std::uint8_t num_steps = 0;            ///< grad; between pings, 1 to 10
    std::uint8_t delay = 0;                ///< ms; between pings, 0 to 100

    friend bool operator==(const AutoTransmit&, const AutoTransmit&) = default;
};
/// Motor current off; ends an automatic scan.
struct MotorOff {
    friend bool operator==(const MotorOff&, const MotorOff&) = default;
};

}  // namespace echoloop::ping
