// Tracks of a DVL as lines of text: $PNORBT0 to $PNORBT9 for the bottom, $PNORWT3 to $PNORWT9 for the water.
// One table of their fields, by which they are written and read. Knows no state and no device.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/nortek/messages.h"

namespace echoloop::nortek {

struct LineField {
    std::string_view name, tag, unit, help;
    int decimals = 0;  ///< of a number; negative: a text
};

/// Lines with the same fields: with a tag before each value, "VX=0.1234", or without.
struct LineForm {
    std::string_view name, help;
    std::span<const LineField> fields;
};
std::span<const LineForm> line_forms();

/// What the address of a line says; nothing if it is none of a track.
struct LineKind {
    const LineForm* form = nullptr;
    bool tags = false;
};
std::optional<LineKind> line_kind(std::string_view address);

/// The address of lines in one of the maker's data formats, 350 to 359 and 404 to 409: 357 is "PNORBT7".
/// Empty for others.
std::string_view line_address(int data_format);

/// A track in such lines, each with its end: one for each beam with PNORBT0 and PNORBT1, else one. `voltage`:
/// V, of the supply.
std::vector<std::string> track_lines(const DvlTrack& track, std::string_view address, double voltage);

/// s, Unix time of the track's trigger.
double unix_time(const DvlTrack& track);

}  // namespace echoloop::nortek
