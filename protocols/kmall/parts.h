// What every KMALL datagram and #MRZ are made of, as plain structs. No wire code: the layouts say how they
// stand on the wire.
#pragma once

#include <cstdint>

#include "protocols/wire/text.h"

namespace echoloop::kmall {

/// Begins every datagram.
struct Header {
    std::uint32_t size = 0;
    wire::Text<4> type;
    std::uint8_t version = 0;
    std::uint8_t system_id = 0;
    std::uint16_t sounder = 0;
    std::uint32_t seconds = 0;
    std::uint32_t nanoseconds = 0;

    friend bool operator==(const Header&, const Header&) = default;
};

/// Datagrams above 64 kB are divided on the wire.
struct Partition {
    std::uint16_t parts = 0;
    std::uint16_t part = 0;

    friend bool operator==(const Partition&, const Partition&) = default;
};

/// Which fan of which ping a datagram is of.
struct Body {
    std::uint16_t size = 0;
    std::uint16_t ping = 0;
    std::uint8_t fans_per_ping = 0;
    std::uint8_t fan = 0;
    std::uint8_t swaths_per_ping = 0;
    std::uint8_t swath = 0;
    std::uint8_t tx_transducer = 0;
    std::uint8_t rx_transducer = 0;
    std::uint8_t rx_transducers = 0;
    std::uint8_t algorithm = 0;

    friend bool operator==(const Body&, const Body&) = default;
};

/// What holds for a whole ping. 144 bytes in version 0, 152 in version 2.
struct PingInfo {
    std::uint16_t size = 0;
    std::uint16_t padding0 = 0;
    float ping_rate = 0;
    std::uint8_t beam_spacing = 0;
    std::uint8_t depth_mode = 0;
    std::uint8_t sub_depth_mode = 0;
    std::uint8_t swath_distance = 0;
    std::uint8_t detection_mode = 0;
    std::uint8_t pulse_form = 0;
    std::uint16_t padding1 = 0;
    float frequency = 0;
    float lowest_frequency = 0;
    float highest_frequency = 0;
    float pulse_length = 0;
    float effective_pulse_length = 0;
    float bandwidth = 0;
    float absorption = 0;
    float port_edge = 0;
    float starboard_edge = 0;
    float port_coverage = 0;
    float starboard_coverage = 0;
    std::int16_t port_coverage_m = 0;
    std::int16_t starboard_coverage_m = 0;
    std::uint8_t stabilisation = 0;
    std::uint8_t filter1 = 0;
    std::uint16_t filter2 = 0;
    std::uint32_t pipe_tracking = 0;
    float transmit_array = 0;
    float receive_array = 0;
    float power = 0;
    std::uint16_t ramp_up = 0;
    std::uint16_t padding2 = 0;
    float yaw = 0;
    std::uint16_t tx_sectors = 0;
    std::uint16_t bytes_per_sector = 0;
    float heading = 0;
    float sound_speed = 0;
    float transducer_depth = 0;
    float water_level = 0;
    float x_offset = 0;
    float y_offset = 0;
    std::uint8_t position_info = 0;
    std::uint8_t position_status = 0;
    std::uint8_t attitude_status = 0;
    std::uint8_t padding3 = 0;
    double latitude = 0;
    double longitude = 0;
    float height = 0;
    float bs_offset = 0;
    std::uint8_t lambert = 0;
    std::uint8_t ice_window = 0;
    std::uint16_t active_modes = 0;

    friend bool operator==(const PingInfo&, const PingInfo&) = default;
};

/// A transmit sector; 36 bytes in version 0, 48 from version 1 on.
struct TxSector {
    std::uint8_t number = 0;
    std::uint8_t array = 0;
    std::uint8_t sub_array = 0;
    std::uint8_t padding0 = 0;
    float delay = 0;
    float tilt = 0;
    float source_level = 0;
    float focus_range = 0;
    float frequency = 0;
    float bandwidth = 0;
    float pulse_length = 0;
    std::uint8_t shading = 0;
    std::uint8_t wave_form = 0;
    std::uint16_t padding1 = 0;
    float voltage = 0;
    float tracking = 0;
    float effective_pulse_length = 0;

    friend bool operator==(const TxSector&, const TxSector&) = default;
};

/// The receiver, and how many soundings follow.
struct RxInfo {
    std::uint16_t size = 0;
    std::uint16_t soundings = 0;
    std::uint16_t valid = 0;
    std::uint16_t bytes_per_sounding = 0;
    float water_column_rate = 0;
    float seabed_image_rate = 0;
    float bs_normal = 0;
    float bs_oblique = 0;
    std::uint16_t alarm = 0;
    std::uint16_t extra_detections = 0;
    std::uint16_t classes = 0;
    std::uint16_t bytes_per_class = 0;

    friend bool operator==(const RxInfo&, const RxInfo&) = default;
};

/// A class of extra detections.
struct DetectionClass {
    std::uint16_t detections = 0;
    std::int8_t padding = 0;
    std::uint8_t alarm = 0;

    friend bool operator==(const DetectionClass&, const DetectionClass&) = default;
};

/// One beam of a ping; port first.
struct Sounding {
    std::uint16_t index = 0;
    std::uint8_t sector = 0;
    std::uint8_t type = 0;
    std::uint8_t method = 0;
    std::uint8_t rejection1 = 0;
    std::uint8_t rejection2 = 0;
    std::uint8_t post_processing = 0;
    std::uint8_t detection_class = 0;
    std::uint8_t confidence = 0;
    std::uint16_t padding = 0;
    float range_factor = 0;
    float quality = 0;
    float vertical_uncertainty = 0;
    float horizontal_uncertainty = 0;
    float window = 0;
    float echo_length = 0;
    std::uint16_t water_beam = 0;
    std::uint16_t water_range = 0;
    float water_angle = 0;
    float absorption = 0;
    float reflectivity1 = 0;
    float reflectivity2 = 0;
    float sensitivity = 0;
    float source_level = 0;
    float bs_calibration = 0;
    float tvg = 0;
    float angle = 0;
    float angle_correction = 0;
    float time = 0;
    float time_correction = 0;
    float delta_latitude = 0;
    float delta_longitude = 0;
    float z = 0;
    float y = 0;
    float x = 0;
    float incidence = 0;
    std::uint16_t cleaning = 0;
    std::uint16_t image_start = 0;
    std::uint16_t image_centre = 0;
    std::uint16_t image_samples = 0;

    friend bool operator==(const Sounding&, const Sounding&) = default;
};

}  // namespace echoloop::kmall
