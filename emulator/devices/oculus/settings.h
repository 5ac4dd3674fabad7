// The options and the profile of an Oculus as typed values. Data only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "emulator/contract/settings_list.h"
#include "protocols/oculus/messages.h"

namespace echoloop::oculus_device {

/// Version of the results.
enum class Answer { as_asked, v1, v2 };

/// On which fires the connection is lost, as users complain of; first: since power-up.
enum class HangUp { never, first, always };

/// Figures of one frequency mode; angles in rad.
struct ModeFigures {
    double frequency = 0;          ///< Hz
    double beam_width = 0;         ///< of one beam, -3 dB
    double fan_height = 0;         ///< -3 dB
    double aperture = 0;           ///< of the sector
    double range = 0;              ///< m, the longest
    double rate = 0;               ///< Hz, the most pings
    double sample_rate = 0;        ///< Hz, of the finest rows
    double bandwidth = 0;          ///< Hz, of the chirp
    double source_level = 0;       ///< dB re 1 uPa at 1 m
    double directivity_index = 0;  ///< dB
    double tvg_absorption = 0;     ///< dB/m, one way
    double tvg_nearest = 0;        ///< m: from there inwards the gain is the same
    double tvg_limit = 0;          ///< dB, the most
    double reference_level = 0;    ///< dB re 1 uPa: reads full scale at 0 % gain and at 1 m before absorption
    double self_noise = 0;         ///< dB re 1 uPa^2/Hz
};

struct Acoustics {
    ModeFigures low, high;
    AxisPattern horizontal, vertical;
    Receiver receiver;  ///< its directivity index and self noise are those of the mode
    ArrayErrors errors;
    double pulse_length = 0;    ///< s
    double shortest_range = 0;  ///< m
    std::size_t rows = 0;       ///< the most of an image
    std::size_t beams = 0;      ///< the most of an image
    double gain_span = 0;       ///< dB from 0 to 100 %
    double tvg_spreading = 0;   ///< dB per decade of range
};

struct Settings {
    std::uint16_t device_id = 1001;  ///< in the status
    std::uint16_t message_id = 0;    ///< device id in dummies and results
    std::uint16_t part_number = 0;
    std::uint16_t status_id = 0;  ///< message id of the status
    std::uint32_t status_bits = 3;
    double status_period = 1;  ///< s
    oculus::Ipv4 mask{};
    double temperature = 10;   ///< degC, at the sonar's own sensor
    double link_speed = 1000;  ///< Mbit/s
    double silence_limit = 0;  ///< s, of a host; 0: none
    HangUp hang_up_on_fire = HangUp::never;
    Answer answer = Answer::as_asked;
    bool data_16_bit_set = true;     ///< flag bit 1 set means 16 bit
    bool percent_in_32_bit = false;  ///< range is a percentage whatever bit 0 says
    bool float_gain_words = false;
    bool scaled_gain_echo = true;  ///< 0 to 100 % is 40 to 100 % in mode 2
    bool echo_used_sound_speed = false;
    bool useless_rate_echo = true;
    bool starboard_negative = false;
    bool garbage_sensors = false;
    double processing_time = 8e-3;  ///< s from the last echo to the message
    bool tvg = true;                ///< the effect of that name
    Sensors sensors;
    Acoustics acoustics;
};

void describe(Settings& settings, OptionList& options, FigureList& figures);
/// From complete options and a complete profile.
Settings read_settings(const DeviceConfig& config);

}  // namespace echoloop::oculus_device
