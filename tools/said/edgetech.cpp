// EdgeTech: port and starboard of a side-scan's ping are two messages, each frequency is a subsystem; a
// sub-bottom profiler's ping is one. Messages of older files (type 82) are another kind of the same.
#include <algorithm>
#include <map>
#include <utility>

#include "protocols/edgetech/codec.h"
#include "tools/said/fields.h"

namespace echoloop::said {
namespace {

using edgetech::Header;

class Edgetech final : public Maker {
  public:
    std::optional<Picture> take(const inspect::Message& message, wire::ByteView bytes, bool sent) override {
        if (!sent || (message.name != "SonarData" && message.name != "OldSideScan")) return std::nullopt;
        const auto parsed = edgetech::parse(bytes);
        if (!parsed) return std::nullopt;
        const Header& header = parsed->header;
        if (const auto* now = std::get_if<edgetech::SonarData>(&parsed->body))
            return add(header, {now->ping, now->interval, now->first_sample, now->sound_speed, levels(*now)});
        if (const auto* old = std::get_if<edgetech::OldSideScan>(&parsed->body))
            return add(header, {old->ping, old->interval, old->first_sample, 0, levels(*old)});
        return std::nullopt;
    }

  private:
    /// What a message says.
    struct Line {
        std::uint32_t ping, interval, first_sample;  ///< interval: ns
        double sound_speed;                          ///< m/s; 0: not told
        std::vector<float> levels;
    };
    /// A ping of one frequency, and what of it is there.
    struct Half {
        Picture picture{};  ///< without bins: nothing
        std::size_t side = 0;
        std::uint32_t ping = 0;
    };

    /// With its second side the picture of a ping is whole; a side alone is one when the next ping comes.
    std::optional<Picture> add(const Header& header, Line line) {
        for (float& level : line.levels) level = decibels(level);
        if (header.subsystem == sub_bottom) {
            Picture picture = begun(header, line, 1);
            picture.levels = std::move(line.levels);
            return checked(std::move(picture));
        }
        Half& half = halves_[{header.type, header.subsystem}];
        const std::size_t side = header.channel == 0 ? 0 : 1;
        const bool same = half.picture.bins > 0 && half.ping == line.ping &&
                          half.picture.bins == line.levels.size() && half.side != side;
        std::optional<Picture> alone;
        if (!same) {
            if (half.picture.bins > 0) alone = checked(std::move(half.picture));
            half = {begun(header, line, 2), side, line.ping};
        }
        half.side = side;
        const std::size_t at = side * half.picture.bins;
        std::ranges::copy(line.levels, half.picture.levels.begin() + static_cast<std::ptrdiff_t>(at));
        if (!same) return alone;
        return checked(std::exchange(half.picture, {}));
    }

    static Picture begun(const Header& header, const Line& line, std::size_t sides) {
        Picture picture;
        picture.name = edgetech::name_of(header) + " " + name_of_subsystem(header.subsystem);
        picture.unit = "dB re 1 V";
        if (sides == 2) {
            picture.waterfall = true;
            picture.bearings = {-1, 1};  // sides, whatever their angles
        } else {
            picture.down = true;
        }
        picture.bins = line.levels.size();
        picture.assumed = !(line.sound_speed > 0);
        const double speed = picture.assumed ? assumed_sound_speed : line.sound_speed;
        picture.bin_size = speed / 2 * 1e-9 * line.interval;
        picture.first_range = picture.bin_size * line.first_sample;
        picture.levels.assign(sides * picture.bins, std::numeric_limits<float>::quiet_NaN());
        return picture;
    }

    static std::string name_of_subsystem(std::uint8_t subsystem) {
        if (subsystem == sub_bottom) return "sub-bottom";
        if (subsystem == edgetech::low_frequency) return "low";
        return subsystem == edgetech::high_frequency ? "high" : std::to_string(subsystem);
    }

    static constexpr std::uint8_t sub_bottom = 0;
    std::map<std::pair<edgetech::Type, std::uint8_t>, Half> halves_;  ///< two frequencies are two pictures
};

}  // namespace

std::unique_ptr<Maker> make_edgetech() { return std::make_unique<Edgetech>(); }

}  // namespace echoloop::said
