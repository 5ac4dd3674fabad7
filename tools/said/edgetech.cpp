// EdgeTech side-scans: port and starboard of a ping are two messages, each frequency is a subsystem.
#include <algorithm>
#include <map>
#include <utility>

#include "protocols/edgetech/codec.h"
#include "tools/said/fields.h"

namespace echoloop::said {
namespace {

class Edgetech final : public Maker {
  public:
    std::optional<Picture> take(const inspect::Message& message, wire::ByteView bytes, bool sent) override {
        if (!sent || message.name != "SonarData") return std::nullopt;
        const auto parsed = edgetech::parse(bytes);
        if (!parsed) return std::nullopt;
        const auto* data = std::get_if<edgetech::SonarData>(&parsed->body);
        if (data == nullptr) return std::nullopt;
        return add(parsed->header, *data);
    }

  private:
    /// A ping of one frequency, and what of it is there.
    struct Half {
        Picture picture{};  ///< without bins: nothing
        std::size_t side = 0;
        std::uint32_t ping = 0;
    };

    /// With its second side the picture of a ping is whole; a side alone is one when the next ping comes.
    std::optional<Picture> add(const edgetech::Header& header, const edgetech::SonarData& data) {
        std::vector<float> levels = edgetech::levels(data);
        for (float& level : levels) level = decibels(level);
        Half& half = halves_[header.subsystem];
        const std::size_t side = header.channel == 0 ? 0 : 1;
        const bool same = half.picture.bins > 0 && half.ping == data.ping &&
                          half.picture.bins == levels.size() && half.side != side;
        std::optional<Picture> alone;
        if (!same) {
            if (half.picture.bins > 0) alone = checked(std::move(half.picture));
            half = {begun(header, data, levels.size()), side, data.ping};
        }
        half.side = side;
        const std::size_t at = side * half.picture.bins;
        std::ranges::copy(levels, half.picture.levels.begin() + static_cast<std::ptrdiff_t>(at));
        if (!same) return alone;
        return checked(std::exchange(half.picture, {}));
    }

    static Picture begun(const edgetech::Header& header, const edgetech::SonarData& data, std::size_t bins) {
        constexpr int low = 20, high = 21;  // subsystems of a 2205
        Picture picture;
        picture.name = "SonarData " + (header.subsystem == low    ? std::string("low")
                                       : header.subsystem == high ? std::string("high")
                                                                  : std::to_string(header.subsystem));
        picture.unit = "dB re 1 V";
        picture.waterfall = true;
        picture.bearings = {-1, 1};  // sides, whatever their angles
        picture.bins = bins;
        const double speed = data.sound_speed > 0 ? double(data.sound_speed) : assumed_sound_speed;
        picture.assumed = !(data.sound_speed > 0);
        picture.bin_size = speed / 2 * 1e-9 * data.interval;
        picture.first_range = picture.bin_size * data.first_sample;
        picture.levels.assign(2 * bins, std::numeric_limits<float>::quiet_NaN());
        return picture;
    }

    std::map<std::uint8_t, Half> halves_;  ///< by subsystem: two frequencies are two pictures
};

}  // namespace

std::unique_ptr<Maker> make_edgetech() { return std::make_unique<Edgetech>(); }

}  // namespace echoloop::said
