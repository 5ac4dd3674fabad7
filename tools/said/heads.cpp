// Sonars of one beam whose echo is one message: scanning heads, echosounders, side-scans, profilers; and two
// multibeams whose soundings are one row of a message.
#include <algorithm>
#include <utility>

#include "protocols/cerulean/surveyor_codec.h"
#include "protocols/imagenex/pipe_ranges.h"
#include "protocols/ping/framer.h"
#include "tools/said/fields.h"

namespace echoloop::said {
namespace {

using inspect::Message;

constexpr double metres_per_second = assumed_sound_speed / 2;  // of two-way time

Picture beam(const Message& message, std::vector<float> levels, std::string unit) {
    Picture picture;
    picture.name = message.name;
    picture.bins = levels.size();
    picture.levels = std::move(levels);
    picture.unit = std::move(unit);
    return picture;
}

/// A picture from `start` on, `length` m in all.
void place(Picture& picture, double start, double length) {
    picture.first_range = start;
    picture.bin_size = picture.bins > 0 ? length / static_cast<double>(picture.bins) : 0;
}

/// 8 bit: 255 is 80 dB. 4 bit: two in a byte, the first in its high half, 0 to 15 over the span.
Picture of_tritech_head(const Message& message) {
    const Fields f(message);
    constexpr double scale = 80.0 / 255, ahead = 3200, circle = 6400;  // dB; 1/16 grad
    constexpr unsigned eight_bits = 0x10;
    const auto status = static_cast<unsigned>(f.number("head_status"));
    std::vector<float> levels;
    const double low = f.number("ad_low") * scale, step = f.number("ad_span") * scale / 15;
    for (const double value : f.numbers("bins")) {
        if ((status & eight_bits) != 0) {
            levels.push_back(static_cast<float>(value * scale));
            continue;
        }
        const auto both = static_cast<unsigned>(value);
        for (const unsigned one : {both >> 4 & 15U, both & 15U})
            levels.push_back(static_cast<float>(low + one * step));
    }
    Picture picture = beam(message, std::move(levels), "dB");
    // In ping-pong every other line is of the other channel, at its own frequency.
    constexpr unsigned ping_pong = 0x800;
    constexpr double tx_step = 32e6 / 4294967296.0 / 1000;  // kHz
    if ((static_cast<unsigned>(f.number("hd_ctrl")) & ping_pong) != 0)
        picture.name += " " + std::to_string(std::lround(f.number("tx_n") * tx_step)) + " kHz";
    picture.pan = (f.number("bearing") - ahead) / circle * 2 * std::numbers::pi;
    picture.bin_size = f.number("ad_interval") * 640e-9 * metres_per_second;
    picture.assumed = true;
    return picture;
}

Picture of_tritech_profiler(const Message& message) {
    const Fields f(message);
    constexpr double ahead = 3200, circle = 6400;
    constexpr unsigned scan_right = 4;
    Picture picture;
    picture.name = message.name;
    picture.assumed = true;
    picture.bearings.clear();
    const bool clockwise = (static_cast<unsigned>(f.number("hd_ctrl")) & scan_right) != 0;
    const double first = f.number(clockwise ? "left_limit" : "right_limit");
    const double step = f.number("step_size") * (clockwise ? 1 : -1);
    for (const double time : f.numbers("echo_times")) {
        const double at = first + step * static_cast<double>(picture.bearings.size());
        picture.bearings.push_back((at - ahead) / circle * 2 * std::numbers::pi);
        picture.ranges.push_back(range_or_none(time * 1e-6 * metres_per_second));
    }
    sort_beams(picture);
    return picture;
}

Picture of_ping360(const Message& message) {
    const Fields f(message);
    Picture picture = beam(message, as_floats(f.numbers("data")), "counts");
    picture.pan = (f.number("angle") - 200) / 200 * std::numbers::pi;
    picture.bin_size = f.number("sample_period") * 25e-9 * metres_per_second;
    picture.assumed = true;
    return picture;
}

Picture of_ping1d(const Message& message) {
    const Fields f(message);
    Picture picture = beam(message, as_floats(f.numbers("profile_data")), "counts");
    place(picture, f.number("scan_start") / 1000, f.number("scan_length") / 1000);
    picture.ranges = {range_or_none(f.number("distance") / 1000)};
    return picture;
}

/// Of an Omniscan and an S500: 0 to 65535 in even steps of dB.
Picture of_cerulean(const Message& message) {
    const Fields f(message);
    const double low = f.number("min_pwr_db"), high = f.number("max_pwr_db");
    std::vector<float> levels;
    for (const double value : f.numbers("pwr_results"))
        levels.push_back(static_cast<float>(low + (high - low) * value / 65535));
    Picture picture = beam(message, std::move(levels), "dB");
    place(picture, f.number("start_mm") / 1000, f.number("length_mm") / 1000);
    picture.waterfall = message.name == "OsMonoProfile";
    if (message.name == "Profile6") picture.ranges = {range_or_none(f.number("this_ping_depth_m"))};
    return picture;
}

Picture of_distance(const Message& message, const char* field) {
    Picture picture;
    picture.name = message.name;
    picture.ranges = {range_or_none(Fields(message).number(field) / 1000)};
    return picture;
}

/// Soundings of a Surveyor: angles positive to port.
std::optional<Picture> of_surveyor(const Message& message, wire::ByteView bytes) {
    const auto found = ping::FrameFinder().find(bytes, true);
    if (!found.frame) return std::nullopt;
    const auto parsed = cerulean::surveyor::Codec::parse(*found.frame);
    if (!parsed) return std::nullopt;
    Picture picture;
    picture.name = message.name;
    picture.down = true;
    picture.bearings.clear();
    if (const auto* points = std::get_if<cerulean::surveyor::AtofPointData>(&*parsed)) {
        for (const auto& point : points->atof_point_data) {
            picture.bearings.push_back(-double(point.angle));
            picture.ranges.push_back(range_or_none(double(point.tof) * points->sos_mps / 2));
        }
    } else if (const auto* places = std::get_if<cerulean::surveyor::YzPointData>(&*parsed)) {
        for (const auto& point : places->yz_point_data) {
            picture.bearings.push_back(std::atan2(-double(point.y), -double(point.z)));
            picture.ranges.push_back(range_or_none(std::hypot(double(point.y), double(point.z))));
        }
    }
    sort_beams(picture);
    return picture;
}

Picture of_delta_t(const Message& message) {
    const Fields f(message);
    constexpr double valid = 0x8000, tenth = 0.1;
    Picture picture;
    picture.name = message.name;
    picture.down = true;
    picture.bearings.clear();
    const double told = f.number("sound_speed");
    const double speed = told >= valid ? (told - valid) * tenth : assumed_sound_speed;
    const double step = f.number("resolution") / 1000 * speed / assumed_sound_speed;
    const double first = f.number("start_angle") / 100 - 180, increment = f.number("angle_increment") / 100;
    for (const double range : f.numbers("ranges")) {
        picture.bearings.push_back(radians(first + increment * static_cast<double>(picture.bearings.size())));
        picture.ranges.push_back(range_or_none(range * step));
    }
    return picture;
}

constexpr double degrees_of_position = 0.3, position_ahead = 600;  // of Imagenex heads
constexpr unsigned position_bits = 0x1FFF;

Picture of_pipe_profiler(const Message& message) {
    const Fields f(message);
    constexpr double half_millimetre = 0.5e-3;
    Picture picture = beam(message, as_floats(f.numbers("data")), "counts");
    const auto position = static_cast<unsigned>(f.number("head_position")) & position_bits;
    picture.pan = radians((position - position_ahead) * degrees_of_position);
    place(picture, 0, imagenex::pipe_range(static_cast<std::uint8_t>(f.number("range_code"))).metres);
    if (const double point = f.number("profile_range") * half_millimetre; point > 0)
        picture.ranges = {range_or_none(point)};
    return picture;
}

class Heads final : public Maker {
  public:
    std::optional<Picture> take(const Message& message, wire::ByteView bytes, bool sent) override {
        const std::string& name = message.name;
        if (name == "SwitchCommand" && !sent) {
            data_bits_ = Fields(message).number("data_bits");
            points_ = 10 * Fields(message).number("data_points");
        }
        if (!sent) return std::nullopt;
        if (name == "HeadData") return checked(of_tritech_head(message));
        if (name == "ProfilerData") return checked(of_tritech_profiler(message));
        if (name == "DeviceData" || name == "AutoDeviceData") return checked(of_ping360(message));
        if (name == "Profile") return checked(of_ping1d(message));
        if (name == "OsMonoProfile" || name == "Profile6") return checked(of_cerulean(message));
        if (name == "Distance" || name == "DistanceSimple") return checked(of_distance(message, "distance"));
        if (name == "Altitude") return checked(of_distance(message, "altitude_mm"));
        if (name == "Distance2") return checked(of_distance(message, "ping_distance_mm"));
        if (name == "IMX" || name == "IGX" || name == "IPX")
            return Fields(message).numbers("data").size() == side_points ? of_side_scan(message)
                                                                         : checked(of_imagenex(message));
        if (name == "IMX831L" || name == "IPX831L") return checked(of_pipe_profiler(message));
        if (name == "83P") return checked(of_delta_t(message));
        if (name == "AtofPointData" || name == "YzPointData") {
            auto picture = of_surveyor(message, bytes);
            return picture ? checked(std::move(*picture)) : std::nullopt;
        }
        return std::nullopt;
    }

  private:
    static constexpr std::size_t side_points = 1000;  ///< that an 872 alone has

    /// An 872 sends port, then starboard of the same ping.
    std::optional<Picture> of_side_scan(const Message& message) {
        const Fields f(message);
        constexpr double port = 256;  // the channel stands where others have their position
        const bool is_port = f.number("head_position") == port;
        std::vector<float> levels = as_floats(f.numbers("data"));
        if (is_port) {
            port_ = std::move(levels);
            return std::nullopt;
        }
        if (port_.empty()) port_.assign(side_points, std::numeric_limits<float>::quiet_NaN());
        port_.insert(port_.end(), levels.begin(), levels.end());
        Picture picture = beam(message, std::exchange(port_, {}), "counts");
        picture.bearings = {-1, 1};  // sides, whatever their angles
        picture.waterfall = true;
        picture.assumed = true;
        picture.bins = side_points;
        place(picture, 0, f.number("range"));
        return checked(std::move(picture));
    }

    /// How many bits a point has the request says; without one they are taken for 8.
    Picture of_imagenex(const Message& message) const {
        const Fields f(message);
        const std::vector<double>& data = f.numbers("data");
        std::vector<float> levels;
        if (data_bits_ == 4) {
            for (const double both : data)
                for (const unsigned one :
                     {static_cast<unsigned>(both) >> 4, static_cast<unsigned>(both) & 15U})
                    levels.push_back(static_cast<float>(one * 17));
        } else if (data_bits_ == 16) {
            for (std::size_t i = 0; i + 1 < data.size(); i += 2)
                levels.push_back(decibels(data[i] + 256 * data[i + 1]));
        } else {
            levels = as_floats(data);
        }
        const auto points = static_cast<std::size_t>(points_);
        if (points > 0 && points < levels.size()) levels.resize(points);  // what fills the reply is none
        Picture picture = beam(message, std::move(levels), data_bits_ == 16 ? decibels_of_counts : "counts");
        const auto place_of_head = static_cast<unsigned>(f.number("head_position")) & position_bits;
        picture.pan = radians((place_of_head - position_ahead) * degrees_of_position);
        const double range = f.number("range");
        place(picture, 0, range);
        constexpr double near = 5, fine = 0.002, coarse = 0.01;  // m; an 852 has coarse steps only
        const double point = f.number("profile_range") * (range < near ? fine : coarse);
        if (point > 0) picture.ranges = {range_or_none(point)};
        return picture;
    }

    std::vector<float> port_;            ///< of an 872's ping
    double data_bits_ = 8, points_ = 0;  ///< as asked for last; 0 points: not known
};

}  // namespace

std::unique_ptr<Maker> make_heads() { return std::make_unique<Heads>(); }

}  // namespace echoloop::said
