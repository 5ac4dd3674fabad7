#include "protocols/imagenex/shot_writer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace echoloop::imagenex {
namespace {

constexpr std::uint16_t valid = 0x8000;
constexpr std::uint16_t sound_speed = valid | 15000;  // 0.1 m/s, what the heads calculate with

/// Index of a shot by the bytes of echo data.
std::uint8_t index_of(std::size_t data) { return data == 0 ? 0 : data <= 128 ? 1 : data <= 252 ? 2 : 3; }

constexpr std::size_t totals[] = {128, 256, 384, 640};

template <class Shot>
void set_time(Shot& shot, double unix_time) {
    using namespace std::chrono;
    constexpr std::array months{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    const auto since = duration_cast<milliseconds>(duration<double>(std::clamp(unix_time, 0.0, 4e9)));
    const auto day = floor<days>(since);
    const year_month_day date{sys_days(day)};
    const hh_mm_ss time(since - day);
    char text[32];
    std::snprintf(text, sizeof text, "%02u-%s-%04d", static_cast<unsigned>(date.day()),
                  months[static_cast<unsigned>(date.month()) - 1], static_cast<int>(date.year()));
    shot.date = std::string_view(text);
    std::snprintf(text, sizeof text, "%02d:%02d:%02d", static_cast<int>(time.hours().count()),
                  static_cast<int>(time.minutes().count()), static_cast<int>(time.seconds().count()));
    shot.time = std::string_view(text);
    std::snprintf(text, sizeof text, ".%02d", static_cast<int>(time.subseconds().count() / 10));
    shot.hundredths = std::string_view(text);
}

/// What all kinds of header have in common.
template <class Shot>
Shot begin(const SwitchCommand& command, const auto& reply, double unix_time) {
    Shot shot;
    set_time(shot, unix_time);
    shot.start_gain = command.start_gain;
    shot.absorption = command.absorption;
    shot.pulse_length = command.pulse_length;
    shot.profile = command.profile;
    shot.sound_speed = sound_speed;
    shot.reply = encode(Message(reply));
    return shot;
}

/// Its size, by the echo data of the reply in it.
template <class Shot>
void fit(Shot& shot, std::size_t data) {
    shot.index = index_of(data);
    shot.total_bytes = static_cast<std::uint16_t>(totals[shot.index]);
    shot.fill.assign(shot.total_bytes - shot_header_bytes - shot.reply.size(), 0);
}

std::uint8_t step_code(std::uint8_t step) {
    return step == 8 ? 4 : static_cast<std::uint8_t>(std::clamp<int>(step, 1, 4) - 1);
}

std::uint8_t bits_code(std::uint8_t bits) { return bits == 4 ? 0 : bits == 16 ? 2 : 1; }

}  // namespace

wire::Bytes ShotWriter::shot(const Reply& reply, double unix_time) {
    return format_ == ShotFormat::shot_852 ? shot_852(reply, unix_time) : shot_81a(reply, unix_time);
}

/// A .852 file knows no shots of 256 bytes: 128 bytes of echo data take 384.
wire::Bytes ShotWriter::shot_852(const Reply& reply, double unix_time) const {
    auto shot = begin<Shot852>(command_, reply, unix_time);
    fit(shot, reply.data.size());
    if (shot.index == 1) {
        shot.index = 2;
        shot.fill.resize(shot.fill.size() + totals[2] - totals[1]);
        shot.total_bytes = static_cast<std::uint16_t>(totals[2]);
    }
    shot.head_id = reply.head_id;
    return encode(FileShot(std::move(shot)));
}

wire::Bytes ShotWriter::shot_81a(const Reply& reply, double unix_time) {
    constexpr std::uint8_t all_around = 120;
    auto shot = begin<Shot81A>(command_, reply, unix_time);
    fit(shot, reply.data.size());
    const bool polar = command_.sector_width >= all_around;
    shot.scan = static_cast<std::uint8_t>((is_clockwise(reply.head_position) ? 0x80 : 0) |
                                          (polar ? 1 << 3 : 0) | step_code(command_.step_size));
    shot.sector_width = command_.sector_width;
    shot.train_angle = command_.train_angle;
    shot.data_setting = static_cast<std::uint8_t>(bits_code(command_.data_bits) << 3 | (command_.logf & 7));
    shot.frequency = static_cast<std::uint16_t>(175 + 5 * command_.frequency);
    const std::size_t pointer = shot.total_bytes + last_shot_;
    shot.fill.end()[-2] = static_cast<std::uint8_t>(pointer >> 8);
    shot.fill.end()[-1] = static_cast<std::uint8_t>(pointer);
    last_shot_ = shot.total_bytes;
    return encode(FileShot(std::move(shot)));
}

wire::Bytes ShotWriter::shot(const PipeReply& reply, double unix_time) {
    constexpr std::uint8_t transducer_up = 0x40, polar = 1 << 3, all_around = 120;
    constexpr std::uint8_t fourteen_bits_20_dB = 0x11;  // as a real shot has it
    auto shot = begin<Shot31L>(command_, reply, unix_time);
    shot.scan = static_cast<std::uint8_t>((is_clockwise(reply.head_position) ? 0x80 : 0) | transducer_up |
                                          (command_.sector_width >= all_around ? polar : 0) |
                                          step_code(command_.step_size));
    shot.sector_width = command_.sector_width;
    shot.train_angle = command_.train_angle;
    shot.range_code = reply.range_code;
    shot.data_setting = fourteen_bits_20_dB;
    shot.frequency = static_cast<std::uint16_t>(1750 + 5 * command_.frequency);
    const double since = last_time_ ? unix_time - *last_time_ : 0;
    last_time_ = unix_time;
    constexpr double fastest = 327.67;  // Hz
    if (since > 0)
        shot.repetition_rate = static_cast<std::uint16_t>(std::lround(100 * std::min(fastest, 1 / since)));
    return encode(FileShot(std::move(shot)));
}

}  // namespace echoloop::imagenex
