// The records of Teledyne Reson 7k sonars as plain structs, all little-endian on the wire. No wire code:
// layouts.h says how they stand there.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "protocols/reson7k/sensors.h"
#include "protocols/reson7k/settings.h"
#include "protocols/wire/bytes.h"
#include "protocols/wire/text.h"

namespace echoloop::reson7k {

/// Before every packet on the network; files have none.
struct NetworkFrame {
    std::uint16_t version = 5;
    std::uint16_t offset = 36;  ///< of the data in this packet
    std::uint32_t packets = 1;
    std::uint16_t records = 1;
    std::uint16_t transmission = 0;  ///< the same in all packets of a record
    std::uint32_t packet_size = 0;   ///< with this frame
    std::uint32_t total_size = 0;    ///< of the record
    std::uint32_t sequence = 0;      ///< from 0
    std::uint32_t destination_device = 0;
    std::uint16_t destination_enumerator = 0;
    std::uint16_t source_enumerator = 0;
    std::uint32_t source_device = 0;

    friend bool operator==(const NetworkFrame&, const NetworkFrame&) = default;
};

/// UTC.
struct Time7k {
    std::uint16_t year = 0;
    std::uint16_t day = 0;  ///< 1 to 366
    float seconds = 0;
    std::uint8_t hours = 0;
    std::uint8_t minutes = 0;

    friend bool operator==(const Time7k&, const Time7k&) = default;
};

inline constexpr std::uint32_t sync_word = 0x0000FFFF;
inline constexpr std::uint16_t checksum_valid = 1;  ///< of RecordFrame::flags

/// Before every record.
struct RecordFrame {
    std::uint16_t version = 5;
    std::uint16_t offset = 60;  ///< from the sync word to the record
    std::uint32_t sync = sync_word;
    std::uint32_t size = 0;  ///< with this frame and the checksum
    std::uint32_t optional_offset = 0;
    std::uint32_t optional_id = 0;
    Time7k time;
    std::uint16_t record_version = 1;
    std::uint32_t type = 0;
    std::uint32_t device = 0;
    std::uint16_t reserved1 = 0;
    std::uint16_t enumerator = 0;
    std::uint32_t reserved2 = 0;
    std::uint16_t flags = checksum_valid;
    std::array<std::uint16_t, 7> reserved3{};

    friend bool operator==(const RecordFrame&, const RecordFrame&) = default;
};

/// 7001. One device only, as this sonar has.
struct Configuration {
    static constexpr std::uint32_t type = 7001;
    std::uint64_t serial = 0;
    std::uint32_t devices = 1;
    std::uint32_t device = 0;
    wire::Text<60> description;
    std::uint32_t card = 0;
    std::uint64_t device_serial = 0;
    std::uint32_t info_size = 0;
    wire::Bytes info;  ///< XML with a 0 at its end
    friend bool operator==(const Configuration&, const Configuration&) = default;
};

struct BeamGeometry {  ///< 7004
    static constexpr std::uint32_t type = 7004;
    std::uint64_t serial = 0;
    std::uint32_t beams = 0;
    std::vector<float> along;          ///< rad
    std::vector<float> across;         ///< rad, positive to starboard
    std::vector<float> width_y;        ///< rad, along the track
    std::vector<float> width_x;        ///< rad, across
    std::vector<std::uint8_t> delays;  ///< nothing, or f32 for each beam
    friend bool operator==(const BeamGeometry&, const BeamGeometry&) = default;
};

struct Image {  ///< 7011
    static constexpr std::uint32_t type = 7011;
    std::uint32_t ping = 0;
    std::uint16_t multi_ping = 0;
    std::uint32_t width = 0, height = 0;
    std::uint16_t depth = 1;  ///< bytes of a pixel
    std::uint16_t reserved1 = 0;
    std::uint16_t compression = 0;
    std::uint32_t samples = 0;  ///< before compression
    std::uint32_t flags = 0;    ///< bit 0: in dB
    float rx_delay = 0;         ///< samples
    std::array<std::uint32_t, 6> reserved2{};
    wire::Bytes pixels;  ///< rows of all beams, left to right
    friend bool operator==(const Image&, const Image&) = default;
};

struct Beamformed {  ///< 7018
    static constexpr std::uint32_t type = 7018;
    std::uint64_t serial = 0;
    std::uint32_t ping = 0;
    std::uint16_t multi_ping = 0;
    std::uint16_t beams = 0;
    std::uint32_t samples = 0;
    std::array<std::uint32_t, 8> reserved{};
    /// Low half: amplitude, u16; high half: phase, s16 in rad x 10430. All beams of sample 0, then of
    /// sample 1.
    std::vector<std::uint32_t> data;
    friend bool operator==(const Beamformed&, const Beamformed&) = default;
};

namespace detection {
inline constexpr std::uint32_t magnitude = 1, phase = 2, quality_type_1 = 1U << 2;
inline constexpr std::uint32_t bright = 1, in_line = 2;  ///< of a quality of type 1
}  // namespace detection

struct Detection {
    std::uint16_t beam = 0;
    float sample = 0;  ///< from the transmission
    float angle = 0;   ///< rad, positive to starboard
    std::uint32_t flags = 0;
    std::uint32_t quality = 0;
    float uncertainty = 0;
    float intensity = 0;               ///< 65535: full scale, with gain and time-varied gain
    float gate_min = 0, gate_max = 0;  ///< samples
    friend bool operator==(const Detection&, const Detection&) = default;
};

struct RawDetections {  ///< 7027
    static constexpr std::uint32_t type = 7027;
    std::uint64_t serial = 0;
    std::uint32_t ping = 0;
    std::uint16_t multi_ping = 0;
    std::uint32_t points = 0;
    std::uint32_t point_size = 34;
    std::uint8_t algorithm = 2;  ///< G2
    std::uint32_t flags = 0;
    float sample_rate = 0;  ///< Hz
    float tx_angle = 0;     ///< rad
    float roll = 0;         ///< rad, that was applied to the gates
    std::array<std::uint32_t, 15> reserved{};
    std::vector<Detection> detections;
    friend bool operator==(const RawDetections&, const RawDetections&) = default;
};

namespace water_column {  // bits of WaterColumn::flags
inline constexpr std::uint32_t to_bottom = 1, no_phase = 2, in_bytes = 4, absolute_gates = 8;
inline constexpr std::uint32_t divisor_shift = 4, thinning_shift = 8;
}  // namespace water_column

struct WaterColumn {  ///< 7042
    static constexpr std::uint32_t type = 7042;
    std::uint64_t serial = 0;
    std::uint32_t ping = 0;
    std::uint16_t multi_ping = 0;
    std::uint16_t beams = 0;
    std::uint32_t samples = 0;             ///< of the range
    std::uint32_t compressed_samples = 0;  ///< of the longest beam
    std::uint32_t flags = 0;
    std::uint32_t first_sample = 0;
    float sample_rate = 0;  ///< Hz, of the samples that are left
    float factor = 0;       ///< of 8-bit decibels; 0: 40
    std::uint32_t reserved = 0;
    wire::Bytes data;  ///< of each beam: u16 number, u32 samples, samples
    friend bool operator==(const WaterColumn&, const WaterColumn&) = default;
};

struct RemoteControl {  ///< 7500
    static constexpr std::uint32_t type = 7500;
    std::uint32_t command = 0;
    std::uint32_t ticket = 0;
    std::array<std::uint64_t, 2> tracking{};
    wire::Bytes parameters;  ///< one byte of 0 if there are none
    friend bool operator==(const RemoteControl&, const RemoteControl&) = default;
};

struct Acknowledge {  ///< 7501
    static constexpr std::uint32_t type = 7501;
    std::uint32_t ticket = 0;
    std::array<std::uint64_t, 2> tracking{};
    friend bool operator==(const Acknowledge&, const Acknowledge&) = default;
};

enum class ErrorCode : std::uint32_t {
    not_ready = 0x7000,
    out_of_range = 0x7001,
    no_such_record = 0x7002,
    unknown_command = 0x7007,
    invalid = 0x7008,
    bad_device = 0x7009,
    subscription_only = 0x700A,
    clipped = 0x700B,
    denied = 0x700C,
};

struct NotAcknowledge {  ///< 7502
    static constexpr std::uint32_t type = 7502;
    std::uint32_t ticket = 0;
    std::array<std::uint64_t, 2> tracking{};
    ErrorCode error = ErrorCode::invalid;
    friend bool operator==(const NotAcknowledge&, const NotAcknowledge&) = default;
};

struct FileDevice {
    std::uint32_t device = 0;
    std::uint16_t enumerator = 0;
    friend bool operator==(const FileDevice&, const FileDevice&) = default;
};

struct FileHeader {  ///< 7200
    static constexpr std::uint32_t type = 7200;
    std::array<std::uint64_t, 2> file_id{};
    std::uint16_t version = 1;
    std::uint16_t reserved = 0;
    std::array<std::uint64_t, 2> session_id{};
    std::uint32_t data_size = 0;
    std::uint32_t count = 0;
    wire::Text<64> name;
    wire::Text<16> program;
    wire::Text<64> user;
    wire::Text<128> notes;
    std::vector<FileDevice> devices;
    wire::Bytes optional;  ///< where the catalog is
    friend bool operator==(const FileHeader&, const FileHeader&) = default;
};

struct CatalogueEntry {
    std::uint32_t size = 0;  ///< B
    std::uint64_t offset = 0;
    std::uint16_t record_type = 0;
    std::uint16_t device = 0;
    std::uint16_t enumerator = 0;
    Time7k time;
    std::uint32_t records = 0;
    std::array<std::uint16_t, 8> reserved{};
    friend bool operator==(const CatalogueEntry&, const CatalogueEntry&) = default;
};
struct FileCatalogue {  ///< 7300
    static constexpr std::uint32_t type = 7300;
    std::uint32_t header_size = 14;
    std::uint16_t version = 1;
    std::uint32_t count = 0;
    std::uint32_t reserved = 0;
    std::vector<CatalogueEntry> entries;
    friend bool operator==(const FileCatalogue&, const FileCatalogue&) = default;
};

using Message =
    std::variant<SonarSettings, Configuration, BeamGeometry, Image, Beamformed, RawDetections, WaterColumn,
                 RemoteControl, Acknowledge, NotAcknowledge, RemoteSettings, AbsorptionLoss, SpreadingLoss,
                 FileHeader, FileCatalogue, Position, RollPitchHeave, ShipHeading, Attitude, SoundSpeed>;

/// A whole record as it came: frame, content, and checksum aside.
struct Record {
    RecordFrame frame;
    wire::Bytes content;  ///< between frame and checksum
    friend bool operator==(const Record&, const Record&) = default;
};

}  // namespace echoloop::reson7k
