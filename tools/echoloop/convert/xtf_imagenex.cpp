// .xtf of an Imagenex 872: a packet for each pair of replies, with the samples as they came. A reply tells
// range and side; the frequency is in the host's command, and so is the moment of the ping.
#include <array>
#include <cmath>
#include <optional>

#include "protocols/imagenex/codec.h"
#include "tools/echoloop/convert/recording.h"
#include "tools/echoloop/convert/xtf_writer.h"

namespace echoloop::convert {
namespace {

constexpr std::size_t samples_of_side = 1000;
constexpr double sound_speed = 1500;  // m/s, by which an 872 turns ranges into times

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

    void begin(std::ostream& out) override {
        const std::array channels{xtf::Channel{false, first_kilohertz_, 1},
                                  xtf::Channel{true, first_kilohertz_, 1}};
        kilohertz_ = first_kilohertz_;
        pinged_.reset();
        put(out, xtf::file_header("Imagenex 872", channels));
    }

    void add(const Heard& heard, std::ostream& out) override {
        auto side = side_in(heard);
        if (!side) return;
        if (!side->starboard || (held_ && held_->slant_range != side->slant_range)) write(out);
        const double time = pinged_.value_or(heard.time);
        pinged_.reset();
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
        put(out, xtf::packet({.seconds = milliseconds / 1000,
                              .milliseconds = static_cast<std::uint32_t>(milliseconds % 1000),
                              .number = static_cast<std::uint32_t>(++count_),
                              .sound_speed = static_cast<float>(sound_speed)},
                             found));
        held_.reset();
        second_.reset();
    }

    double kilohertz_ = 0, first_kilohertz_ = 0;  ///< 0: no command was heard
    std::optional<double> pinged_;                ///< s, when the host asked for what was not answered yet
    std::optional<xtf::Side> held_, second_;
    double time_ = 0;  ///< s, of what is held
};

}  // namespace

std::unique_ptr<Recording> make_xtf_872() { return std::make_unique<Xtf872>(); }

}  // namespace echoloop::convert
