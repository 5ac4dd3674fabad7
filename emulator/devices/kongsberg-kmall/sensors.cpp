#include "emulator/devices/kongsberg-kmall/sensors.h"

#include <algorithm>

#include "emulator/devices/kongsberg-kmall/soundings.h"
#include "protocols/nmea/navigation.h"

namespace echoloop::kongsberg_kmall {
namespace {

// An EM 2042's: fixes twice a second, and 102 samples of motion at 100 Hz in a datagram.
constexpr Time fix_interval = std::chrono::milliseconds(500);
constexpr Time sample_interval = std::chrono::milliseconds(10);
constexpr int samples_at_once = 102;
constexpr Time motion_interval = samples_at_once * sample_interval;

constexpr double height_error = 0.077;  // m, of a real #SPE and its GST
constexpr const char* talker = "GP";

/// A time of the run on the sounder's clock, in the two numbers of a datagram.
struct Stamp {
    Stamp(Time time, const Settings& settings) {
        constexpr std::int64_t billion = 1'000'000'000;
        const auto whole = static_cast<std::int64_t>(settings.unix_start);
        const auto part = static_cast<std::int64_t>((settings.unix_start - static_cast<double>(whole)) * 1e9);
        const std::int64_t all = part + time.count();
        seconds = static_cast<std::uint32_t>(whole + all / billion);
        nanoseconds = static_cast<std::uint32_t>(all % billion);
    }
    std::uint32_t seconds = 0, nanoseconds = 0;
};

template <class T>
T stamped(Time time, const Settings& settings) {
    const Stamp stamp(time, settings);
    T value;
    value.seconds = stamp.seconds, value.nanoseconds = stamp.nanoseconds;
    return value;
}

/// All datagrams have an even length.
std::string even(std::string text) {
    if (text.size() % 2 != 0) text += '\0';
    return text;
}

kmall::MotionSample sample_of(const survey::Reading& r, const Settings& settings) {
    auto s = stamped<kmall::MotionSample>(r.time, settings);
    s.mark = "#KMB";
    s.size = 132;
    s.version = 1;
    s.status = 0x70;  // no accelerations, errors or delayed heave
    s.latitude = r.place.latitude, s.longitude = r.place.longitude;
    s.height = f(r.place.height);
    s.roll = f(r.roll), s.pitch = f(r.pitch), s.heading = f(r.heading), s.heave = f(r.heave);
    s.roll_rate = f(r.roll_rate), s.pitch_rate = f(r.pitch_rate), s.yaw_rate = f(r.yaw_rate);
    s.velocity_north = f(r.north), s.velocity_east = f(r.east), s.velocity_down = f(r.down);
    return s;
}

}  // namespace

ShipSensors::ShipSensors(const Settings& s)
    : fixes_(s.sensors, {s.latitude, s.longitude}),
      motions_(s.sensors, {s.latitude, s.longitude}),
      next_fix_(s.sensor_datagrams ? fix_interval : Time::max()),
      next_motion_(s.sensor_datagrams ? motion_interval : Time::max()) {}

Time ShipSensors::wake() const { return std::min(next_fix_, next_motion_); }

std::vector<Time> ShipSensors::moments(Time now) {
    asked_ = Asked::nothing;
    if (next_fix_ <= now) {
        asked_ = Asked::fix;
        const Time fix = next_fix_;
        while (next_fix_ <= now) next_fix_ += fix_interval;
        return {fix};
    }
    if (next_motion_ > now) return {};
    asked_ = Asked::motion;
    std::vector<Time> times;
    for (int i = samples_at_once; i > 0; --i) times.push_back(next_motion_ - i * sample_interval);
    while (next_motion_ <= now) next_motion_ += motion_interval;
    return times;
}

std::vector<kmall::Datagram> ShipSensors::datagrams(std::span<const Located> places,
                                                    const Settings& settings) {
    std::vector<kmall::Datagram> out;
    if (places.empty()) return out;
    if (asked_ == Asked::fix) tell_fix(fixes_.read(places.front()), settings, out);
    if (asked_ == Asked::motion) out.push_back(motion(places, settings));
    return out;
}

kmall::Header ShipSensors::header(const char* type, std::uint8_t version, Time time,
                                  const Settings& s) const {
    auto h = stamped<kmall::Header>(time, s);
    h.type = type;
    h.version = version;
    h.system_id = s.system_id;
    h.sounder = s.sounder;
    return h;
}

/// In the order of real files: clock, position, position of the antenna, its error, sound speed.
void ShipSensors::tell_fix(const survey::Reading& r, const Settings& s,
                           std::vector<kmall::Datagram>& out) const {
    const nmea::Fix fix{
        {s.unix_start + to_seconds(r.time)}, r.place.latitude, r.place.longitude, r.place.height};
    const auto sensor = [&](const char* type, std::uint8_t version, kmall::SensorInfo info, auto values,
                            std::string text) {
        kmall::Sensor datagram;
        datagram.header = header(type, version, r.time, s);
        datagram.info = info;
        datagram.values = values;
        datagram.text = even(std::move(text));
        out.push_back(std::move(datagram));
    };
    kmall::Clock clock;
    clock.deviation =
        static_cast<std::int32_t>(s.sensors.read("clock", 0, {.drift = 3000, .noise = 2000}, r.time));
    sensor("#SCL", 1, {.system = 5, .status = 1}, clock, nmea::zda(fix.time, talker));

    constexpr std::uint16_t own_time_moved_and_active = 0x601;  // of a real #SPO
    auto position = stamped<kmall::Position>(r.time, s);
    position.fix_quality = 1.1F;  // as real ones
    position.latitude = r.place.latitude, position.longitude = r.place.longitude;
    position.speed = f(r.speed), position.course = f(r.course);
    position.height = f(r.place.height);
    const std::string gga = nmea::gga(fix, talker);
    sensor("#SPO", 0, {.status = own_time_moved_and_active}, position, gga);
    sensor("#CPO", 0, {.status = own_time_moved_and_active}, position, gga);

    auto error = stamped<kmall::PositionError>(r.time, s);
    error.rms = 0.03F;
    error.major_axis = error.minor_axis = error.latitude = error.longitude = f(position_error);
    error.height = f(height_error);
    sensor("#SPE", 0, {.status = 1}, error, nmea::gst(fix.time, position_error, height_error, talker));

    kmall::SoundSpeeds sound;
    sound.header = header("#SVT", 0, r.time, s);
    sound.info = {.status = 1, .format = 1, .contents = 1, .filter = 60};
    auto speed = stamped<kmall::SoundSpeedSample>(r.time, s);
    constexpr float absent = -9999;
    speed.sound_speed = f(s.sensors.read("sound speed", s.sound_speed, stray::sound_speed, r.time));
    speed.temperature = speed.pressure = speed.salinity = absent;
    sound.samples = {speed};
    out.push_back(std::move(sound));
}

/// Its header has the time of the first sample, as an EM 2040P's.
kmall::Motion ShipSensors::motion(std::span<const Located> places, const Settings& s) {
    kmall::Motion m;
    m.header = header("#SKM", 1, places.front().time, s);
    m.info = {.status = 1,
              .format = 1,
              .contents = 0xF};  // KM binary: position and velocity, attitude, heading, heave
    for (const Located& place : places) m.samples.push_back(sample_of(motions_.read(place), s));
    return m;
}

}  // namespace echoloop::kongsberg_kmall
