// EdgeTech side-scans: port and starboard of a ping are two messages.
#include <algorithm>

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
    /// With its second side the picture of a ping is whole; a side alone is one when the next ping comes.
    std::optional<Picture> add(const edgetech::Header& header, const edgetech::SonarData& data) {
        std::vector<float> levels = edgetech::levels(data);
        for (float& level : levels) level = decibels(level);
        const std::size_t side = header.channel == 0 ? 0 : 1;
        const bool same = picture_.bins > 0 && subsystem_ == header.subsystem && ping_ == data.ping &&
                          picture_.bins == levels.size() && side_ != side;
        std::optional<Picture> alone;
        if (!same) {
            if (picture_.bins > 0) alone = checked(std::move(picture_));
            begin(header, data, levels.size());
        }
        side_ = side;
        std::ranges::copy(levels,
                          picture_.levels.begin() + static_cast<std::ptrdiff_t>(side * picture_.bins));
        if (!same) return alone;
        auto done = checked(std::move(picture_));
        picture_ = {};
        return done;
    }

    void begin(const edgetech::Header& header, const edgetech::SonarData& data, std::size_t bins) {
        subsystem_ = header.subsystem;
        ping_ = data.ping;
        picture_ = {};
        picture_.name = "SonarData";
        picture_.unit = "dB re 1 V";
        picture_.waterfall = true;
        picture_.bearings = {-1, 1};  // sides, whatever their angles
        picture_.bins = bins;
        const double speed = data.sound_speed > 0 ? double(data.sound_speed) : assumed_sound_speed;
        picture_.assumed = !(data.sound_speed > 0);
        picture_.bin_size = speed / 2 * 1e-9 * data.interval;
        picture_.first_range = picture_.bin_size * data.first_sample;
        picture_.levels.assign(2 * bins, std::numeric_limits<float>::quiet_NaN());
    }

    Picture picture_;
    std::size_t side_ = 0;
    std::uint32_t ping_ = 0;
    std::uint8_t subsystem_ = 0;
};

}  // namespace

std::unique_ptr<Maker> make_edgetech() { return std::make_unique<Edgetech>(); }

}  // namespace echoloop::said
