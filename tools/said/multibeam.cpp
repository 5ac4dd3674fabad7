// Multibeam echosounders: soundings, and the water column where it is on the wire.
#include <algorithm>
#include <utility>

#include "protocols/kmall/codec.h"
#include "protocols/norbit/codec.h"
#include "protocols/norbit/framer.h"
#include "protocols/reson7k/codec.h"
#include "protocols/reson7k/framer.h"
#include "protocols/wire/read.h"
#include "tools/said/fields.h"

namespace echoloop::said {
namespace {

using inspect::Message;

Picture downward(const Message& message) {
    Picture picture;
    picture.name = message.name;
    picture.down = true;
    picture.bearings.clear();
    return picture;
}

std::optional<Picture> finished(Picture picture) {
    sort_beams(picture);
    return checked(std::move(picture));
}

template <class T>
T little(wire::ByteView bytes, std::size_t at) {
    return wire::load<wire::ByteOrder::little, T>(bytes.data() + at);
}

class Kmall final : public Maker {
  public:
    std::optional<Picture> take(const Message& message, wire::ByteView bytes, bool sent) override {
        image_.reset();
        if (!sent) return std::nullopt;
        if (message.name.ends_with(" part")) {  // MWC part
            if (!kmall::join(held_, bytes)) return std::nullopt;
            bytes = held_;
        } else if (message.name != "MRZ" && message.name != "MWC") {
            return std::nullopt;
        }
        const auto datagram = kmall::parse(bytes);
        if (!datagram) return std::nullopt;
        if (const auto* mrz = std::get_if<kmall::Mrz>(&*datagram)) {
            image_ = seabed_image(*mrz);
            return of(*mrz);
        }
        if (const auto* mwc = std::get_if<kmall::Mwc>(&*datagram)) return of(*mwc);
        return std::nullopt;
    }

    std::optional<Picture> also() override { return std::exchange(image_, std::nullopt); }

  private:
    /// The samples around each sounding of the bottom, the one at its centre where the sounding is.
    static std::optional<Picture> seabed_image(const kmall::Mrz& mrz) {
        constexpr std::uint8_t normal = 0;
        constexpr double farthest = 1e6, tenth = 0.1;  // samples; dB
        const double rate = mrz.rx.seabed_image_rate;
        std::vector<Strip> strips;
        std::size_t next = 0;  // of all samples
        for (const auto& s : mrz.soundings) {
            const std::size_t from = std::exchange(next, next + s.image_samples);
            if (next > mrz.image.size()) break;
            const double bearing = -radians(double(s.angle) + s.angle_correction);
            const double first = std::round((double(s.time) + s.time_correction) * rate) + 1 - s.image_centre;
            if (s.type != normal || s.image_samples == 0 || !std::isfinite(bearing)) continue;
            if (!(first >= 0 && first < farthest)) continue;
            strips.push_back({bearing, static_cast<std::size_t>(first), {}});
            for (std::size_t i = from; i < next; ++i)
                strips.back().levels.push_back(static_cast<float>(tenth * mrz.image[i]));
        }
        Picture picture;
        picture.name = "MRZ seabed image";
        picture.unit = "dB";
        picture.down = true;
        return picture_of(std::move(strips), std::move(picture), double(mrz.ping.sound_speed) / (2 * rate));
    }

    static std::optional<Picture> of(const kmall::Mrz& mrz) {
        constexpr std::uint8_t normal = 0;
        Picture picture;
        picture.name = "MRZ";
        picture.down = true;
        picture.bearings.clear();
        for (const auto& s : mrz.soundings) {
            if (s.type > 1) continue;
            picture.bearings.push_back(-radians(double(s.angle) + s.angle_correction));
            const double time = double(s.time) + s.time_correction;
            picture.ranges.push_back(
                s.type == normal && s.method == 0 ? 0 : range_or_none(time * mrz.ping.sound_speed / 2));
        }
        return finished(std::move(picture));
    }

    static std::optional<Picture> of(const kmall::Mwc& mwc) {
        Picture picture;
        picture.name = "MWC";
        picture.down = true;
        picture.bearings.clear();
        picture.unit = "dB";
        for (const auto& beam : mwc.beams) {
            picture.bearings.push_back(-radians(beam.info.angle));
            picture.bins = std::max(picture.bins, beam.amplitude.size() + beam.info.start);
        }
        picture.bin_size = double(mwc.rx.sound_speed) / (2 * double(mwc.rx.sample_rate));
        constexpr std::size_t most = std::size_t{32} << 20;
        if (picture.bins == 0 || mwc.beams.size() > most / picture.bins) return std::nullopt;
        picture.levels.assign(mwc.beams.size() * picture.bins, std::numeric_limits<float>::quiet_NaN());
        for (std::size_t i = 0; i < mwc.beams.size(); ++i)
            for (std::size_t k = 0; k < mwc.beams[i].amplitude.size(); ++k)
                picture.levels[i * picture.bins + mwc.beams[i].info.start + k] =
                    0.5F * static_cast<float>(mwc.beams[i].amplitude[k]);
        return finished(std::move(picture));
    }

    wire::Bytes held_;
    std::optional<Picture> image_;
};

class Reson7k final : public Maker {
  public:
    std::optional<Picture> take(const Message& message, wire::ByteView bytes, bool sent) override {
        if (!sent) return std::nullopt;
        const Fields f(message);
        if (const double speed = f.number("conditions.sound_speed"); speed > 0) speed_ = speed;
        if (const double rate = f.number("settings.sample_rate"); rate > 0) rate_ = rate;
        if (message.name == "BeamGeometry") across_ = f.numbers("across");
        if (message.name != "RawDetections" && message.name != "Beamformed" && message.name != "Image" &&
            message.name != "WaterColumn")
            return std::nullopt;
        const auto found = reson7k::RecordFinder().find(bytes, true);
        if (!found.frame) return std::nullopt;
        const auto parsed = reson7k::parse(*found.frame);
        if (!parsed) return std::nullopt;
        Picture picture = downward(message);
        picture.assumed = speed_ == assumed_sound_speed;
        std::visit(
            [&](const auto& m) {
                if constexpr (requires { add(m, picture); }) add(m, picture);
            },
            *parsed);
        return finished(std::move(picture));
    }

  private:
    void add(const reson7k::RawDetections& record, Picture& picture) const {
        for (const auto& point : record.detections) {
            picture.bearings.push_back(point.angle);
            picture.ranges.push_back(range_or_none(double(point.sample) / record.sample_rate * speed_ / 2));
        }
    }

    void add(const reson7k::Beamformed& record, Picture& picture) const {
        picture.bearings = across_;
        picture.unit = decibels_of_counts;
        picture.bins = record.samples;
        picture.bin_size = speed_ / 2 / rate_;
        picture.levels.resize(record.data.size());
        for (std::size_t beam = 0; beam < record.beams; ++beam)
            for (std::size_t bin = 0; bin < picture.bins; ++bin)
                picture.levels[beam * picture.bins + bin] =
                    decibels(record.data[bin * record.beams + beam] & 0xFFFF);
    }

    void add(const reson7k::Image& record, Picture& picture) const {
        const std::size_t beams = record.width, rows = record.height;
        if (record.depth != 1 || rows == 0 || record.pixels.size() != beams * rows) return;
        picture.bearings = across_;
        picture.unit = "counts";
        picture.bins = rows;
        const double per_row = std::ceil(double(record.samples) / double(rows));
        picture.bin_size = per_row * speed_ / 2 / rate_;
        picture.levels.resize(record.pixels.size());
        for (std::size_t beam = 0; beam < beams; ++beam)
            for (std::size_t row = 0; row < rows; ++row)
                picture.levels[beam * rows + row] = record.pixels[row * beams + beam];
    }

    /// Of each beam: u16 number, u32 samples, samples: amplitude and perhaps phase, of 16 or 8 bits.
    void add(const reson7k::WaterColumn& record, Picture& picture) const {
        namespace bits = reson7k::water_column;
        constexpr std::uint32_t of_32_bits = 1U << 12;
        constexpr std::size_t beam_head = 6;
        const bool in_bytes = (record.flags & bits::in_bytes) != 0;
        const std::size_t size = (in_bytes ? 1U : 2U) * ((record.flags & bits::no_phase) != 0 ? 1U : 2U);
        const double step = record.factor > 0 ? 20 / double(record.factor) : 0.5;  // dB of an 8-bit amplitude
        const wire::ByteView data(record.data);
        if ((record.flags & of_32_bits) != 0 || record.compressed_samples > data.size()) return;
        picture.unit = decibels_of_counts;
        picture.bins = record.compressed_samples;
        picture.first_range = record.first_sample * speed_ / 2 / record.sample_rate;
        picture.bin_size = speed_ / 2 / record.sample_rate;
        for (std::size_t at = 0; at + beam_head <= data.size();) {
            const std::size_t beam = little<std::uint16_t>(data, at);
            const std::size_t count = little<std::uint32_t>(data, at + 2);
            at += beam_head;
            if (count > picture.bins || count > (data.size() - at) / size || beam >= across_.size()) return;
            picture.bearings.push_back(across_[beam]);
            for (std::size_t k = 0; k < count; ++k, at += size)
                picture.levels.push_back(in_bytes ? static_cast<float>(step * data[at])
                                                  : decibels(little<std::uint16_t>(data, at)));
            picture.levels.resize(picture.bearings.size() * picture.bins,
                                  std::numeric_limits<float>::quiet_NaN());
        }
    }

    double speed_ = assumed_sound_speed, rate_ = 0;
    std::vector<double> across_;
};

class Norbit final : public Maker {
  public:
    std::optional<Picture> take(const Message& message, wire::ByteView bytes, bool sent) override {
        if (!sent) return std::nullopt;
        const auto found = norbit::PacketFinder().find(bytes, true);
        if (!found.frame) return std::nullopt;
        const auto parsed = norbit::parse(*found.frame);
        if (!parsed) return std::nullopt;
        Picture picture = downward(message);
        if (const auto* b = std::get_if<norbit::Bathymetry>(&*parsed)) {
            for (const auto& point : b->points) {
                picture.bearings.push_back(point.angle);
                picture.ranges.push_back(
                    range_or_none(double(point.sample) * b->sound_speed / (2 * double(b->sample_rate))));
            }
        } else if (!add(std::get<norbit::WaterColumn>(*parsed), picture)) {
            return std::nullopt;
        }
        return finished(std::move(picture));
    }

  private:
    static bool add(const norbit::WaterColumn& w, Picture& picture) {
        const auto image = norbit::image_of(w);
        if (!image) return false;
        const double bin = double(w.sound_speed) / (2 * double(w.sample_rate));
        picture.down = w.sonar_mode != norbit::SonarMode::forward_looking;
        picture.bins = w.samples;
        picture.bin_size = bin;
        picture.first_range = w.t0 * bin;
        const bool bytes = image->sample_bytes == 1;
        picture.unit = bytes ? "counts" : decibels_of_counts;
        picture.levels.resize(std::size_t{w.beams} * w.samples);
        for (std::size_t beam = 0; beam < w.beams; ++beam) {
            picture.bearings.push_back(little<float>(image->angles, 4 * beam));
            for (std::size_t row = 0; row < w.samples; ++row) {
                const double value =
                    sample(w.sample, image->samples, (row * w.beams + beam) * image->sample_bytes);
                picture.levels[beam * w.samples + row] =
                    bytes ? static_cast<float>(value) : decibels(std::abs(value));
            }
        }
        return true;
    }

    static double sample(norbit::Sample type, wire::ByteView bytes, std::size_t at) {
        using S = norbit::Sample;
        switch (type) {
            case S::u8:
                return bytes[at];
            case S::s8:
                return little<std::int8_t>(bytes, at);
            case S::u16:
                return little<std::uint16_t>(bytes, at);
            case S::s16:
                return little<std::int16_t>(bytes, at);
            case S::u32:
                return little<std::uint32_t>(bytes, at);
            case S::s32:
                return little<std::int32_t>(bytes, at);
            case S::u64:
                return static_cast<double>(little<std::uint64_t>(bytes, at));
            case S::s64:
                return static_cast<double>(little<std::int64_t>(bytes, at));
            case S::f32:
                return little<float>(bytes, at);
            case S::f64:
                return little<double>(bytes, at);
        }
        return 0;
    }
};

}  // namespace

std::unique_ptr<Maker> make_kmall() { return std::make_unique<Kmall>(); }
std::unique_ptr<Maker> make_reson7k() { return std::make_unique<Reson7k>(); }
std::unique_ptr<Maker> make_norbit() { return std::make_unique<Norbit>(); }

}  // namespace echoloop::said
