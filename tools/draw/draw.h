// Pictures and tables of echograms on disk. Draws what it is given: renders nothing, and never changes a
// level other than by the display gain that the colour bar names.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/echogram.h"
#include "tools/draw/image.h"

namespace echoloop::draw {

class Canvas;

/// What is drawn before it is a file: lines and letters stay such, so that they are sharp at any size.
struct Picture {
    Image pixels;                        ///< echoes on the background, the whole picture
    std::function<void(Canvas&)> lines;  ///< draws axes, labels and curves over them

    /// With the lines on it.
    operator Image() const;
};

/// How a picture looks. Levels are dB re 1 uPa for EchoRule::radiometric; EchoRule::cerqueira2016 is drawn
/// linear from 0 to 1 and ignores the level members.
struct Style {
    std::string title;  ///< first line, usually the device; a second line gives range, frequency, beams
    int width = 1000;   ///< px, 400..4000; the height follows from the sector
    std::optional<double> top;  ///< dB of the brightest colour, display gain included; unset: the level that
                                ///< one value in a thousand exceeds, rounded up to 5 dB
    double span = 50;           ///< dB from the brightest to the darkest colour
    double spreading = 30;      ///< display gain, dB per decade of slant range; 0 shows received levels
    double absorption = 0;      ///< display gain, dB/m one way
};

/// Draws pings in polar form: the sonar at the centre, bearing 0 up, starboard to the right, slant range
/// outwards. One echogram is a fan; many are a scan of the head, a later ping replaces an earlier one at the
/// same bearing. Throws std::invalid_argument if there is no value to draw, the pings differ in EchoRule, an
/// echogram's sizes do not fit together, or a member of `style` is out of bounds.
Picture polar_picture(std::span<const Echogram> pings, const Style& style);

/// Pings of a sonar of one beam, or of one to each side, in the order of time.
struct Waterfall {
    std::span<const Echogram> pings;
    std::span<const double> times;  ///< s, of every ping, ascending
    std::vector<bool> to_port;      ///< of every beam: its range runs to the left
    bool echogram = false;          ///< time runs to the right and range down, as echosounders are drawn
};

/// Draws each ping as a line over slant range: the first at the top and range to the right, or to both sides
/// of the middle, unless it is an echogram. Lines are equally thick whatever the time between them. Throws as
/// polar_picture(), and if there are other than one or two beams, or two to the same side.
Picture waterfall_picture(const Waterfall& waterfall, const Style& style);

enum class PictureFormat { png, svg, pdf };

/// By the ending of a name; empty: it is none of them.
std::optional<PictureFormat> picture_format_of(const std::filesystem::path& name);

/// Writes a picture; a pixel is a point (1/72 inch) of SVG and PDF. Throws as write_png().
void write_picture(const std::filesystem::path& path, PictureFormat format, const Picture& picture);

/// Writes an 8-bit RGB PNG. The writers throw std::runtime_error with the path and the reason.
void write_png(const std::filesystem::path& path, const Image& image);

/// Writes values as text: a header row "bearing_deg" and the slant ranges of the bins in m, then one row per
/// beam, in the order of the pings, with its bearing in degrees (pan + bearing, starboard positive) and its
/// values as they are in the echogram (uPa^2, or 0..1). All pings have the ranges of the first, or
/// std::invalid_argument is thrown.
void write_csv(const std::filesystem::path& path, std::span<const Echogram> pings);

/// Writes the same values as a NumPy array (.npy version 1.0): float32, little endian, shape beams x bins.
void write_npy(const std::filesystem::path& path, std::span<const Echogram> pings);

}  // namespace echoloop::draw
