// .xtf of an EdgeTech side-scan: a packet for each ping with port and starboard. Samples of all pings have
// one scale: programs that apply the weight of a channel do so in whole numbers, and would leave nothing.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "protocols/edgetech/codec.h"
#include "tools/echoloop/convert/recording.h"
#include "tools/echoloop/convert/xtf_writer.h"

namespace echoloop::convert {
namespace {

using edgetech::SonarData;

constexpr std::size_t xtf_sides = 2, most_subsystems = 3;
constexpr std::uint8_t starboard = 1;

double middle_frequency(const SonarData& data) {
    return (edgetech::start_frequency(data) + edgetech::end_frequency(data)) / 2;
}
/// s
double duration(const SonarData& data) { return 1e-9 * data.interval * double(edgetech::sample_count(data)); }

xtf::Ping ping_of(const SonarData& d) {
    namespace valid = edgetech::valid;
    constexpr double turn = 180.0 / 32768, arc = 60e4;
    const auto says = [&](auto what) { return (d.validity & what) != 0; };
    xtf::Ping ping{.seconds = d.seconds,
                   .milliseconds = d.milliseconds % 1000,
                   .number = d.ping,
                   .sound_speed = d.sound_speed};
    if (says(valid::speed)) ping.speed = static_cast<float>(0.1 * d.speed);
    if (says(valid::heading)) ping.heading = static_cast<float>(0.01 * d.heading);
    if (says(valid::position) && d.position_units == 2) ping.position = {d.y / arc, d.x / arc};
    if (says(valid::depth)) ping.depth = static_cast<float>(1e-3 * d.depth);
    if (says(valid::altitude)) ping.altitude = static_cast<float>(1e-3 * d.altitude);
    if (says(valid::pitch_roll))
        ping.pitch_roll = {static_cast<float>(turn * d.pitch), static_cast<float>(turn * d.roll)};
    return ping;
}

class Xtf final : public Recording {
  public:
    void look(const Heard& heard) override {
        const auto side = side_in(heard);
        if (!side) return;
        const std::vector<float> levels = edgetech::levels(side->data);
        for (const float level : levels) strongest_ = std::max(strongest_, level);
        if (subsystems_.size() < most_subsystems) subsystems_.try_emplace(side->subsystem, side->data);
    }

    void begin(std::ostream& out) override {
        std::vector<xtf::Channel> channels;
        for (const auto& [subsystem, data] : subsystems_)
            for (const bool to_starboard : {false, true})
                channels.push_back({to_starboard, middle_frequency(data) / 1000});  // kHz, as in packets
        put(out, xtf::file_header("EdgeTech", channels));
    }

    void add(const Heard& heard, std::ostream& out) override {
        auto side = side_in(heard);
        if (!side || !subsystems_.contains(side->subsystem)) return;
        if (held_ && (held_->subsystem != side->subsystem || held_->data.ping != side->data.ping ||
                      held_->channel == side->channel))
            write(out);
        if (held_)
            second_ = std::move(side);
        else
            held_ = std::move(side);
        if (second_) write(out);
    }

    void end(std::ostream& out) override { write(out); }

  private:
    struct SideData {
        std::uint8_t subsystem = 0, channel = 0;
        SonarData data;
    };

    static std::optional<SideData> side_in(const Heard& heard) {
        auto message = edgetech::parse(heard.bytes);
        if (!message) return std::nullopt;
        auto* data = std::get_if<SonarData>(&message->body);
        if (data == nullptr || edgetech::levels(*data).empty()) return std::nullopt;
        const std::uint8_t channel = message->header.channel == 0 ? 0 : starboard;
        return SideData{message->header.subsystem, channel, std::move(*data)};
    }

    /// A packet of what is held: one side or both.
    void write(std::ostream& out) {
        if (!held_) return;
        std::vector<const SideData*> found{&*held_};
        if (second_) found.push_back(&*second_);
        std::ranges::sort(found, {}, &SideData::channel);
        std::vector<xtf::Side> written;
        for (const SideData* side : found) written.push_back(side_of(*side));
        put(out, xtf::packet(ping_of(found[0]->data), written));
        ++count_;
        held_.reset();
        second_.reset();
    }

    xtf::Side side_of(const SideData& side) const {
        const SonarData& d = side.data;
        const auto place = std::distance(subsystems_.begin(), subsystems_.find(side.subsystem));
        const double c = d.sound_speed > 0 ? double(d.sound_speed) : 1500;
        constexpr double full_scale = 65535;
        const double scale = strongest_ > 0 ? full_scale / double(strongest_) : 0;
        Bytes samples;
        for (const float level : edgetech::levels(d)) {
            const auto word = static_cast<std::uint16_t>(std::lround(scale * double(level)));
            samples.push_back(static_cast<std::uint8_t>(word));
            samples.push_back(static_cast<std::uint8_t>(word >> 8));
        }
        return {
            .channel = static_cast<std::uint16_t>(xtf_sides * static_cast<std::size_t>(place) + side.channel),
            .starboard = side.channel == starboard,
            .slant_range = c / 2 * duration(d),
            .duration = duration(d),
            .delay = 1e-9 * d.interval * d.first_sample,
            .kilohertz = middle_frequency(d) / 1000,
            .samples = std::move(samples)};
    }

    std::map<std::uint8_t, SonarData> subsystems_;  ///< with a side of each
    float strongest_ = 0;                           ///< level of all pings
    std::optional<SideData> held_, second_;
};

}  // namespace

std::unique_ptr<Recording> make_xtf() { return std::make_unique<Xtf>(); }

}  // namespace echoloop::convert
