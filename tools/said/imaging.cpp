// Imaging sonars: all beams of a ping are one message, or come in parts.
#include "protocols/aris/beams.h"
#include "protocols/aris/codec.h"
#include "protocols/aris/frames.h"
#include "protocols/oculus/codec.h"
#include "protocols/oculus/framer.h"
#include "protocols/sonar3d/codec.h"
#include "tools/said/fields.h"

namespace echoloop::said {
namespace {

using inspect::Message;

double little_endian(const std::uint8_t* bytes, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
    return value;
}

template <class M>
std::optional<Picture> of_result(const std::string& name, const M& result) {
    const auto image = oculus::image_of(result);
    if (!image) return std::nullopt;
    Picture picture;
    picture.name = name;
    picture.bearings.clear();
    for (const auto bearing : result.bearings) picture.bearings.push_back(radians(bearing / 100.0));
    const std::size_t beams = picture.bearings.size(), size = image->sample_bytes;
    const std::size_t before = image->gain_words ? 4 : 0;
    picture.bins = result.ranges;
    picture.bin_size = result.range_resolution;
    picture.unit = size == 1 ? "counts" : decibels_of_counts;
    picture.levels.resize(beams * picture.bins);
    for (std::size_t bin = 0; bin < picture.bins; ++bin) {
        const std::uint8_t* row = image->bytes.data() + bin * image->row_bytes + before;
        for (std::size_t beam = 0; beam < beams; ++beam) {
            const double value = little_endian(row + beam * size, size);
            picture.levels[beam * picture.bins + bin] =
                size == 1 ? static_cast<float>(value) : decibels(value);
        }
    }
    sort_beams(picture);
    return checked(std::move(picture));
}

class Oculus final : public Maker {
  public:
    std::optional<Picture> take(const Message& message, wire::ByteView bytes, bool sent) override {
        if (!sent || !message.name.starts_with("Result")) return std::nullopt;
        const auto found = oculus::MessageFinder().find(bytes, true);
        if (!found.frame) return std::nullopt;
        const auto parsed = oculus::parse(*found.frame);
        if (!parsed) return std::nullopt;
        return std::visit(
            [&]<class M>(const M& result) -> std::optional<Picture> {
                if constexpr (requires { oculus::image_of(result); })
                    return of_result(message.name, result);
                else
                    return std::nullopt;
            },
            *parsed);
    }
};

/// Beam 0 is the right-most, and angles grow to the left.
class Aris final : public Maker {
  public:
    std::optional<Picture> take(const Message& message, wire::ByteView bytes, bool sent) override {
        if (!sent || message.name != "FramePart") return std::nullopt;
        const auto part = aris::parse_frame_part(bytes);
        const auto frame = part ? frames_.add(*part) : std::nullopt;
        if (!frame) return std::nullopt;
        const aris::FrameHeader& header = frame->header;
        const std::size_t beams = aris::find_ping_mode(header.ping_mode)->beams;
        Picture picture;
        picture.name = "frame";
        picture.bearings.clear();
        for (const double angle : aris::centre_angles(beams, header.large_lens != 0))
            picture.bearings.push_back(-radians(angle));
        picture.bins = header.samples;
        picture.first_range = header.window_start;
        picture.bin_size = double(header.window_length) / header.samples;
        picture.unit = "counts";
        picture.levels.resize(beams * picture.bins);
        for (std::size_t bin = 0; bin < picture.bins; ++bin)
            for (std::size_t beam = 0; beam < beams; ++beam)
                picture.levels[beam * picture.bins + bin] = frame->samples[bin * beams + beam];
        if (picture.bearings.size() != beams) return std::nullopt;
        sort_beams(picture);
        return checked(std::move(picture));
    }

  private:
    aris::FrameJoiner frames_;
};

/// Of each direction the range in one message, and the strength of that echo in another.
class Sonar3d final : public Maker {
  public:
    std::optional<Picture> take(const Message& message, wire::ByteView bytes, bool sent) override {
        if (!sent || (message.name != "RangeImage" && message.name != "BitmapImageGreyscale8"))
            return std::nullopt;
        const auto packet = sonar3d::parse(bytes);
        if (!packet) return std::nullopt;
        if (const auto* ranges = std::get_if<sonar3d::RangeImage>(&packet->message)) {
            auto picture = begun(message, *ranges);
            for (const std::uint32_t pixel : ranges->image_pixel_data)
                picture.ranges.push_back(range_or_none(double(pixel) * ranges->image_pixel_scale));
            return checked(std::move(picture));
        }
        if (const auto* strengths = std::get_if<sonar3d::BitmapImage>(&packet->message)) {
            auto picture = begun(message, *strengths);
            picture.unit = "counts";
            picture.bins = 1;
            picture.bin_size = strengths->range;  // it is somewhere in it
            picture.levels.assign(strengths->image_pixel_data.begin(), strengths->image_pixel_data.end());
            return checked(std::move(picture));
        }
        return std::nullopt;
    }

  private:
    /// Without a direction where it says that there are too many.
    template <class M>
    static Picture begun(const Message& message, const M& image) {
        constexpr std::uint32_t most = 4096;
        Picture picture;
        picture.name = message.name;
        const bool fits = image.width <= most && image.height <= most;
        picture.bearings = steps(fits ? image.width : 0, image.fov_horizontal);
        picture.elevations = steps(fits ? image.height : 0, image.fov_vertical);  // row 0 is the lowest
        return picture;
    }

    static std::vector<double> steps(std::size_t count, double degrees) {
        std::vector<double> all;
        for (std::size_t i = 0; i < count; ++i)
            all.push_back(count > 1 ? radians(degrees) * (double(i) / double(count - 1) - 0.5) : 0);
        return all;
    }
};

}  // namespace

std::unique_ptr<Maker> make_oculus() { return std::make_unique<Oculus>(); }
std::unique_ptr<Maker> make_aris() { return std::make_unique<Aris>(); }
std::unique_ptr<Maker> make_sonar3d() { return std::make_unique<Sonar3d>(); }

}  // namespace echoloop::said
