#include "emulator/devices/aris/frame.h"

#include <algorithm>
#include <cmath>

#include "emulator/devices/aris/sensors.h"
#include "emulator/devices/aris/version.h"
#include "protocols/aris/codec.h"

namespace echoloop::aris_device {
namespace {

constexpr std::size_t part_overhead = 32;  // B of keys and numbers, at most

void copy_settings(const aris::SetAcoustics& from, aris::FrameHeader& to) {
    to.gain = static_cast<std::uint32_t>(std::lround(from.gain));
    to.sample_rate = 1e6F / static_cast<float>(from.sample_period);
    to.ping_mode = from.ping_mode;
    to.frequency = from.frequency;
    to.pulse_width = from.pulse_width;
    to.cycle_period = from.cycle_period;
    to.sample_period = from.sample_period;
    to.transmit = from.transmit;
    to.frame_rate = from.frame_rate;
    to.samples = from.samples;
    to.volts_150 = from.volts_150;
    to.start_delay = from.start_delay;
}

void copy_control(const FrameRecord& from, aris::FrameHeader& to) {
    to.large_lens = from.telephoto;
    to.salinity = from.salinity;
    to.applied = from.cookies.applied;
    to.constrained = from.cookies.constrained;
    to.invalid = from.cookies.invalid;
    to.delay_enabled = from.delay.enable;
    to.delay_period = from.delay.period;
    to.focus = from.focus.target();
    to.focus_position = from.focus.position(from.time);
    to.focus_moving = to.focus != to.focus_position;
}

void put_attitude(const Quat& world_from_sonar, const Sensors& sensors, Time time, aris::FrameHeader& to) {
    const Attitude attitude = attitude_of(world_from_sonar);
    const auto read = sensors.at(time);
    const Vec3& g = attitude.acceleration;
    to.compass_heading =
        static_cast<float>(sensors.read_bearing("compass", attitude.heading, stray::compass, time));
    to.compass_pitch = read("pitch", attitude.pitch, stray::tilt);
    to.compass_roll = read("roll", attitude.roll, stray::tilt);
    to.acceleration = {read("x", g.x, stray::acceleration), read("y", g.y, stray::acceleration),
                       read("z", g.z, stray::acceleration)};
}

std::size_t room(const Settings& settings, bool first) {
    return settings.datagram - part_overhead - (first ? aris::header_bytes : 0);
}

}  // namespace

aris::FrameHeader make_header(const FrameRecord& frame, const Settings& settings,
                              const Pose& world_from_sonar) {
    const Sensors& sensors = settings.sensors;
    const double depth = sensors.read("pressure", -world_from_sonar.position.z, stray::depth, frame.time);
    const double water = sensors.read("water", settings.temperature, stray::water_temperature, frame.time);
    const auto board = [&](std::string_view name) {
        const double read = sensors.read(name, settings.temperature, stray::board_temperature, frame.time);
        return static_cast<std::uint32_t>(std::lround(std::max(0.0, read)));
    };
    aris::FrameHeader header;
    copy_settings(frame.acoustics, header);
    copy_control(frame, header);
    put_attitude(world_from_sonar.orientation, sensors, frame.time, header);
    const double c = sound_speed(water, frame.salinity, depth);
    header.index = frame.number;
    header.timestamp = header.sonar_time = header.go_time = frame.clock;
    header.window_start = static_cast<float>(c / 2 * 1e-6 * frame.acoustics.start_delay);
    header.window_length =
        static_cast<float>(c / 2 * 1e-6 * frame.acoustics.sample_period * frame.acoustics.samples);
    header.temperature1 = board("board 1");
    header.temperature2 = board("board 2");
    header.water_temperature = static_cast<float>(water);
    header.sound_speed = static_cast<float>(c);
    header.system_type = settings.variant.system_type;
    header.serial = settings.serial;
    header.reordered = settings.reordered;
    header.pressure = static_cast<float>(pressure_at(depth, frame.salinity, water));
    header.uptime = static_cast<std::uint32_t>(to_seconds(frame.time));
    header.version_build = version_build;
    header.version_major = version_major;
    header.version_minor = version_minor;
    header.variant = settings.voyager ? 2 : 0;
    return header;
}

double part_delay(const FrameRecord& frame, const Settings& settings) {
    constexpr std::uint32_t longest = 100'000;  // us
    return frame.delay.enable ? 1e-6 * std::min(frame.delay.period, longest) : settings.part_delay;
}

std::size_t part_count(const FrameRecord& frame, const Settings& settings) {
    const std::size_t first = room(settings, true), others = room(settings, false);
    const std::size_t rest = frame.bytes() > first ? frame.bytes() - first : 0;
    return 1 + (rest + others - 1) / others;
}

std::vector<Bytes> make_parts(const FrameRecord& frame, const Settings& settings, const Echogram& echogram) {
    Bytes samples(frame.bytes());
    write_samples(echogram, frame, settings, samples);
    aris::FramePart part;
    part.frame_index = frame.number;
    part.total_data_size = static_cast<std::uint32_t>(samples.size());
    part.header = aris::encode(make_header(frame, settings, echogram.world_from_sonar));
    std::vector<Bytes> out;
    out.reserve(part_count(frame, settings));
    for (std::size_t at = 0; at < samples.size(); at += part.data.size()) {
        const std::size_t size = std::min(samples.size() - at, room(settings, at == 0));
        const auto from = samples.begin() + static_cast<std::ptrdiff_t>(at);
        part.data.assign(from, from + static_cast<std::ptrdiff_t>(size));
        part.data_offset = static_cast<std::uint32_t>(at);
        out.push_back(aris::encode(part));
        part.header.clear();
    }
    return out;
}

}  // namespace echoloop::aris_device
