// KMALL's datagrams, and the text commands of its controller, as plain structs. No wire code.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "protocols/kmall/info_parts.h"
#include "protocols/kmall/parts.h"
#include "protocols/kmall/sensor_parts.h"
#include "protocols/kmall/water_parts.h"
#include "protocols/wire/bytes.h"

namespace echoloop::kmall {

inline constexpr std::size_t largest_datagram = 65000;  ///< B; above it a datagram is divided on the wire

/// Bathymetry of one fan. Sizes and counts are written as the vectors are.
struct Mrz {
    Header header;
    Partition partition{1, 1};
    Body body;
    PingInfo ping;
    std::vector<TxSector> sectors;
    RxInfo rx;
    std::vector<DetectionClass> classes;
    std::vector<Sounding> soundings;  ///< of the bottom, then extra detections
    std::vector<std::int16_t> image;  ///< seabed image of all soundings, 0.1 dB

    friend bool operator==(const Mrz&, const Mrz&) = default;
};

struct WaterBeam {
    WaterBeamInfo info;
    std::vector<std::int8_t> amplitude;  ///< 0.5 dB
    std::vector<std::int16_t> phase;     ///< empty, or as many

    friend bool operator==(const WaterBeam&, const WaterBeam&) = default;
};

/// The water column of one fan.
struct Mwc {
    Header header;
    Partition partition{1, 1};
    Body body;
    WaterTx tx;
    std::vector<WaterSector> sectors;
    WaterRx rx;
    std::vector<WaterBeam> beams;

    friend bool operator==(const Mwc&, const Mwc&) = default;
};

/// One of several parts of a datagram: what follows the partition.
struct Part {
    Header header;
    Partition partition;
    wire::Bytes bytes;

    friend bool operator==(const Part&, const Part&) = default;
};

/// #IIP, installation, or #IOP, runtime parameters, as text.
struct Parameters {
    Header header;
    ParametersInfo info;
    std::string text;
    wire::Bytes surplus{};  ///< a zero that makes the length even

    friend bool operator==(const Parameters&, const Parameters&) = default;
};

/// #SVP: a profile of the speed of sound.
struct SoundProfile {
    Header header;
    SoundProfileInfo info;
    std::vector<SoundProfilePoint> points;
    wire::Bytes surplus{};  ///< behind them: real systems have one more point, which means nothing

    friend bool operator==(const SoundProfile&, const SoundProfile&) = default;
};

/// #SPO, #CPO, #SPE, #SPD, #SCL, #SDE, #SHI, #SSM: what one sensor says at once.
struct Sensor {
    Header header;
    SensorInfo info;
    std::variant<Position, PositionError, Datum, Clock, DepthSensor0, DepthSensor, Height, SoundSpeedManager>
        values;
    std::string text;  ///< the sensor's own sentence, and a zero where that makes the length even

    friend bool operator==(const Sensor&, const Sensor&) = default;
};

/// #SHA.
struct Headings {
    Header header;
    SensorInfo info;
    HeadingsInfo about;
    std::vector<HeadingSample> samples;
    std::vector<std::string> texts;  ///< one each

    friend bool operator==(const Headings&, const Headings&) = default;
};

/// #SVT.
struct SoundSpeeds {
    Header header;
    SoundSpeedInfo info;
    std::vector<SoundSpeedSample> samples;

    friend bool operator==(const SoundSpeeds&, const SoundSpeeds&) = default;
};

/// #SKM.
struct Motion {
    Header header;
    MotionInfo info;
    std::vector<MotionSample> samples;

    friend bool operator==(const Motion&, const Motion&) = default;
};

/// #CHE.
struct PingHeave {
    Header header;
    Body body;
    Heave heave;

    friend bool operator==(const PingHeave&, const PingHeave&) = default;
};

/// #FCF.
struct CalibrationFile {
    Header header;
    Partition partition{1, 1};
    FileInfo info;
    wire::Bytes bytes;

    friend bool operator==(const CalibrationFile&, const CalibrationFile&) = default;
};

/// Text "$KSSIS,number,sounder,..." of a controller or its host.
struct Command {
    unsigned number = 0;
    std::string sounder;    ///< its name, e.g. "EM2040_40"; "" in the controller's list of sounders
    std::string arguments;  ///< with the comma before them where there is a name, and a line's end or padding

    friend bool operator==(const Command&, const Command&) = default;
};

/// A sound speed profile for the sounder, "$MVS01,00000,...": sound_text.h reads what it says.
struct SoundText {
    std::string text;

    friend bool operator==(const SoundText&, const SoundText&) = default;
};

using Datagram = std::variant<Mrz, Mwc, Part, Parameters, SoundProfile, Sensor, Headings, SoundSpeeds, Motion,
                              PingHeave, CalibrationFile, Command, SoundText>;

}  // namespace echoloop::kmall
