// .xtf of a side-scan: a header with a description of each channel, then a packet for each ping with port and
// starboard. Offsets as pyxtf and auvlib read them. Samples of all pings have one scale: programs that apply
// the weight of a channel do so in whole numbers, and would leave nothing.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>

#include "protocols/edgetech/codec.h"
#include "protocols/wire/bytes.h"
#include "tools/echoloop/convert/recording.h"

namespace echoloop::convert {
namespace {

using edgetech::SonarData;

constexpr std::size_t file_header = 1024, channel_info_at = 256, channel_info = 128;
constexpr std::size_t ping_header = 256, channel_header = 64, unit = 64, sides = 2, most_subsystems = 3;
constexpr std::uint8_t starboard = 1;

class Block {
  public:
    explicit Block(std::size_t size) : bytes_(size) {}
    template <class T>
    void set(std::size_t at, T value) {
        wire::store<wire::ByteOrder::little>(value, bytes_.data() + at);
    }
    void text(std::size_t at, std::string_view text) {
        std::ranges::copy(text, bytes_.begin() + static_cast<std::ptrdiff_t>(at));
    }
    const Bytes& bytes() const { return bytes_; }

  private:
    Bytes bytes_;
};

double middle_frequency(const SonarData& data) {
    return (edgetech::start_frequency(data) + edgetech::end_frequency(data)) / 2;
}
/// s
double duration(const SonarData& data) { return 1e-9 * data.interval * double(edgetech::sample_count(data)); }

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
        constexpr std::uint16_t latitude_longitude = 3;
        Block header(file_header);
        header.set(0, std::uint8_t{0x7B});
        header.set(1, std::uint8_t{1});
        header.text(2, "echoloop");
        header.text(10, "223");
        header.text(18, "EdgeTech");
        header.set(164, latitude_longitude);
        header.set(166, static_cast<std::uint16_t>(sides * subsystems_.size()));
        std::size_t at = channel_info_at;
        std::uint8_t number = 0;
        for (const auto& [subsystem, data] : subsystems_)
            for (const std::uint8_t side : {std::uint8_t{0}, starboard}) {
                constexpr std::uint16_t slant = 1, unipolar = 1, sample_bytes = 2;
                constexpr std::uint8_t port_type = 1, sixteen_bits = 3;
                header.set(at, static_cast<std::uint8_t>(port_type + side));
                header.set(at + 1, number++);
                header.set(at + 2, slant);
                header.set(at + 4, unipolar);
                header.set(at + 6, sample_bytes);
                header.set(at + 8, std::uint32_t{1024});
                header.text(at + 12, side == starboard ? "starboard" : "port");
                header.set(at + 32, static_cast<float>(middle_frequency(data) / 1000));  // kHz, as in packets
                header.set(at + 74, sixteen_bits);
                at += channel_info;
            }
        put(out, header.bytes());
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
        std::size_t size = ping_header;
        for (const SideData* side : found) size += channel_header + 2 * edgetech::sample_count(side->data);
        Block packet((size + unit - 1) / unit * unit);
        packet.set(0, std::uint16_t{0xFACE});
        packet.set(4, static_cast<std::uint16_t>(found.size()));
        packet.set(10, static_cast<std::uint32_t>(packet.bytes().size()));
        write_ping(packet, found[0]->data);
        std::size_t at = ping_header;
        for (const SideData* side : found) at = write_channel(packet, at, *side);
        put(out, packet.bytes());
        ++count_;
        held_.reset();
        second_.reset();
    }

    void write_ping(Block& packet, const SonarData& d) const {
        namespace valid = edgetech::valid;
        const std::time_t seconds = d.seconds;
        std::tm at{};
        ::gmtime_r(&seconds, &at);
        const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
        packet.set(14, static_cast<std::uint16_t>(at.tm_year + 1900));
        const std::array<int, 5> date{at.tm_mon + 1, at.tm_mday, at.tm_hour, at.tm_min, at.tm_sec};
        for (std::size_t i = 0; i < date.size(); ++i) packet.set(16 + i, byte(date[i]));
        packet.set(21, byte(static_cast<int>(d.milliseconds % 1000 / 10)));
        packet.set(22, static_cast<std::uint16_t>(at.tm_yday + 1));
        packet.set(28, d.ping);
        packet.set(32, d.sound_speed / 2);  // by convention that of one way
        packet.set(72, d.sound_speed);
        constexpr double turn = 180.0 / 32768, arc = 60e4;
        const auto heading = static_cast<float>(0.01 * d.heading);
        if ((d.validity & valid::speed) != 0)
            for (const std::size_t place : {120U, 152U}) packet.set(place, static_cast<float>(0.1 * d.speed));
        if ((d.validity & valid::heading) != 0)
            for (const std::size_t place : {124U, 212U}) packet.set(place, heading);
        if ((d.validity & valid::position) != 0 && d.position_units == 2)
            for (const std::size_t place : {128U, 160U}) {
                packet.set(place, d.y / arc);
                packet.set(place + 8, d.x / arc);
            }
        if ((d.validity & valid::depth) != 0) packet.set(192, static_cast<float>(1e-3 * d.depth));
        if ((d.validity & valid::altitude) != 0) packet.set(196, static_cast<float>(1e-3 * d.altitude));
        if ((d.validity & valid::pitch_roll) != 0) {
            packet.set(204, static_cast<float>(turn * d.pitch));
            packet.set(208, static_cast<float>(turn * d.roll));
        }
    }

    /// Where the next one begins. Port goes from far to near, so that both lie side by side as a picture.
    std::size_t write_channel(Block& packet, std::size_t at, const SideData& side) const {
        const SonarData& d = side.data;
        const std::vector<float> levels = edgetech::levels(d);
        const auto place = std::distance(subsystems_.begin(), subsystems_.find(side.subsystem));
        const double c = d.sound_speed > 0 ? double(d.sound_speed) : 1500;
        packet.set(at, static_cast<std::uint16_t>(sides * static_cast<std::size_t>(place) + side.channel));
        packet.set(at + 4, static_cast<float>(c / 2 * duration(d)));
        packet.set(at + 12, static_cast<float>(1e-9 * d.interval * d.first_sample));
        packet.set(at + 16, static_cast<float>(duration(d)));
        packet.set(at + 20, static_cast<float>(duration(d)));
        packet.set(at + 26, static_cast<std::uint16_t>(std::lround(middle_frequency(d) / 1000)));
        packet.set(at + 42, static_cast<std::uint32_t>(levels.size()));
        at += channel_header;
        constexpr double full_scale = 65535;
        const double scale = strongest_ > 0 ? full_scale / double(strongest_) : 0;
        for (std::size_t i = 0; i < levels.size(); ++i) {
            const std::size_t from = side.channel == starboard ? i : levels.size() - 1 - i;
            packet.set(at + 2 * i, static_cast<std::uint16_t>(std::lround(scale * double(levels[from]))));
        }
        return at + 2 * levels.size();
    }

    std::map<std::uint8_t, SonarData> subsystems_;  ///< with a side of each
    float strongest_ = 0;                           ///< level of all pings
    std::optional<SideData> held_, second_;
};

}  // namespace

std::unique_ptr<Recording> make_xtf() { return std::make_unique<Xtf>(); }

}  // namespace echoloop::convert
