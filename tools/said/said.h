// Pictures out of the messages of a sonar, by nothing but what they say: what a driver can see. Of a port
// that speaks a known family; never throws for what bytes hold, and opens nothing.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/inspect.h"

namespace echoloop::said {

/// Where messages do not tell the speed of sound: the one that most of the makers' manuals count with.
inline constexpr double assumed_sound_speed = 1500;  // m/s

/// Levels of beams and bins, or the range that each beam tells, or both.
struct Picture {
    std::string name;                   ///< of the message: "DeviceData"
    std::vector<double> bearings{0};    ///< rad, ascending, clockwise (starboard positive); one a column
    std::vector<double> elevations{0};  ///< rad, up; one a row
    bool numbered = false;              ///< of a Doppler log: messages tell no bearings, beams are 0, 1, 2
    double pan = 0;                     ///< rad, clockwise, of a head that turns
    bool waterfall = false;             ///< of a side-scan: one beam, or port and starboard
    bool down = false;                  ///< the middle looks down, not ahead
    double first_range = 0;             ///< m, of the leading edge of bin 0
    double bin_size = 0;                ///< m
    std::size_t bins = 0;  ///< of rows of beams 1: the strength of an echo whose range another message tells
    std::vector<float> levels{};  ///< rows x columns x bins, beam by beam; NaN: nothing
    std::string unit{};           ///< of the levels: "counts" of 8 bits, or "dB ..."
    std::vector<float> ranges{};  ///< m, rows x columns; 0: none; empty: the message tells none
    bool assumed = false;         ///< ranges are those at assumed_sound_speed
};

/// What one family's messages say. It keeps what comes in parts.
class Maker {
  public:
    Maker() = default;
    virtual ~Maker() = default;
    Maker(const Maker&) = delete;
    Maker& operator=(const Maker&) = delete;

    /// The picture that this message completes. `bytes`: all of the message's; `sent`: by the sonar.
    virtual std::optional<Picture> take(const inspect::Message& message, wire::ByteView bytes, bool sent) = 0;
    /// The next picture that the same message completes, until there is none.
    virtual std::optional<Picture> also() { return std::nullopt; }
    /// Messages of this name were not taken: what they had begun becomes no picture.
    virtual void skipped(std::string_view) {}
};

/// For the messages of one sonar; nullptr for a family that has no pictures.
std::unique_ptr<Maker> maker_of(std::string_view family);

}  // namespace echoloop::said
