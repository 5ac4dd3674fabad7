// .xtf of an Imagenex 872: a packet for each pair of replies, with the samples as they came. A reply tells
// range and side; the frequency is in the host's command, and so is the moment of the ping. Where the sonar
// was says a recording of ours in a comment (`run --record-truth`).
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "emulator/truth/remark.h"
#include "protocols/imagenex/codec.h"
#include "tools/echoloop/convert/recording.h"
#include "tools/echoloop/convert/xtf_writer.h"

namespace echoloop::convert {
namespace {

constexpr std::size_t samples_of_side = 1000;
constexpr double sound_speed = 1500;  // m/s, by which an 872 turns ranges into times

/// What a comment says of the sonar's place; x of it is to the bow.
void tell_place(xtf::Ping& ping, const Remark& remark) {
    const Pose& pose = remark.world_from_sonar;
    const Vec3 bow = rotate(pose.orientation, {1, 0, 0}), port = rotate(pose.orientation, {0, 1, 0}),
               up = rotate(pose.orientation, {0, 0, 1});
    const double heading = rad_to_deg(std::atan2(bow.x, bow.y));
    ping.heading = static_cast<float>(heading < 0 ? heading + 360 : heading);
    ping.pitch_roll = {static_cast<float>(rad_to_deg(std::asin(std::clamp(bow.z, -1.0, 1.0)))),
                       static_cast<float>(rad_to_deg(std::atan2(port.z, up.z)))};
    ping.depth = static_cast<float>(std::max(0.0, -pose.position.z));
    if (remark.around.altitude) ping.altitude = static_cast<float>(*remark.around.altitude);
    ping.position = {pose.position.y, pose.position.x};
    if (const auto& place = remark.around.place) ping.position = {place->latitude, place->longitude};
}

/// kn over ground from one place to the next; nothing if no time has passed.
std::optional<float> speed(const std::optional<Remark>& before, const Remark& now) {
    constexpr double knot = 1852.0 / 3600;
    if (!before || !(now.time > before->time)) return std::nullopt;
    const Vec3 way = now.world_from_sonar.position - before->world_from_sonar.position;
    return static_cast<float>(std::hypot(way.x, way.y) / (now.time - before->time) / knot);
}

class Xtf872 final : public Recording {
  public:
    void asked(const Heard& heard) override {
        const auto command = imagenex::parse_switch_command(heard.bytes);
        if (!command) return;
        // Sheet 445-029 calls the highest 800 kHz, a known host 770.
        constexpr std::array kilohertz{260.0, 330.0, 800.0};
        constexpr std::uint8_t port_packet = 0;
        if (command->reserved7 < kilohertz.size()) kilohertz_ = kilohertz[command->reserved7];
        if (first_kilohertz_ == 0) first_kilohertz_ = kilohertz_;
        if (command->trigger == port_packet || !held_) pinged_ = heard.time;
    }

    void look(const Heard& heard) override {
        if (const auto remark = read_remark(heard.comment))
            units_ = remark->around.place ? xtf::Units::degrees : xtf::Units::metres;
    }

    void begin(std::ostream& out) override {
        const std::array channels{xtf::Channel{false, first_kilohertz_, 1},
                                  xtf::Channel{true, first_kilohertz_, 1}};
        kilohertz_ = first_kilohertz_;
        pinged_.reset();
        put(out, xtf::file_header("Imagenex 872", channels, units_));
    }

    void add(const Heard& heard, std::ostream& out) override {
        auto side = side_in(heard);
        if (!side) return;
        if (!side->starboard || (held_ && held_->slant_range != side->slant_range)) write(out);
        const double time = pinged_.value_or(heard.time);
        pinged_.reset();
        if (auto remark = read_remark(heard.comment)) remark_ = remark;
        if (held_) {
            second_ = std::move(side);
        } else {
            held_ = std::move(side);
            time_ = time;
        }
        if (held_->starboard || second_) write(out);
    }

    void end(std::ostream& out) override { write(out); }

  private:
    std::optional<xtf::Side> side_in(const Heard& heard) const {
        const auto message = imagenex::parse(heard.bytes);
        if (!message) return std::nullopt;
        const auto* reply = std::get_if<imagenex::Reply>(&*message);
        if (reply == nullptr || reply->data.size() != samples_of_side) return std::nullopt;
        const std::uint64_t channel = reply->head_position >> 7;  // byte 6: 1 starboard, 2 port
        if (channel != 1 && channel != 2) return std::nullopt;
        const bool is_starboard = channel == 1;
        return xtf::Side{.channel = is_starboard ? std::uint16_t{1} : std::uint16_t{0},
                         .starboard = is_starboard,
                         .slant_range = double(reply->range),
                         .duration = 2 * reply->range / sound_speed,
                         .kilohertz = kilohertz_,
                         .sample_bytes = 1,
                         .samples = reply->data};
    }

    /// A packet of what is held: one side or both.
    void write(std::ostream& out) {
        if (!held_) return;
        std::vector<xtf::Side> found{std::move(*held_)};
        if (second_) found.push_back(std::move(*second_));
        const auto milliseconds = std::llround(1e3 * time_);
        xtf::Ping ping{.seconds = milliseconds / 1000,
                       .milliseconds = static_cast<std::uint32_t>(milliseconds % 1000),
                       .number = static_cast<std::uint32_t>(++count_),
                       .sound_speed = static_cast<float>(sound_speed)};
        if (remark_) {
            tell_place(ping, *remark_);
            ping.speed = speed(place_before_, *remark_);
            place_before_ = std::exchange(remark_, std::nullopt);
        }
        put(out, xtf::packet(ping, found));
        held_.reset();
        second_.reset();
    }

    double kilohertz_ = 0, first_kilohertz_ = 0;  ///< 0: no command was heard
    std::optional<double> pinged_;                ///< s, when the host asked for what was not answered yet
    std::optional<xtf::Side> held_, second_;
    double time_ = 0;                              ///< s, of what is held
    std::optional<Remark> remark_, place_before_;  ///< on what is held, on the ping before
    xtf::Units units_ = xtf::Units::degrees;
};

}  // namespace

std::unique_ptr<Recording> make_xtf_872() { return std::make_unique<Xtf872>(); }

}  // namespace echoloop::convert
