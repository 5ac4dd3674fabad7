#include "emulator/devices/dvl-wayfinder/commands.h"

#include <chrono>
#include <cstdio>

#include "emulator/devices/family/doppler/moment.h"

namespace echoloop::dvl_wayfinder {
namespace {

using wayfinder::CommandId, wayfinder::Outcome, wayfinder::Wrong;

constexpr std::uint8_t slow = 3, fast = 7;  // codes of 9600 and 115200 bit/s
constexpr double slow_rate = 9600, fast_rate = 115200;
constexpr float least_sound_speed = 1400, most_sound_speed = 1600;  // m/s
constexpr float least_range = 1, longest_range = 60;                // m

Answer refused(CommandId command, Outcome outcome, Wrong wrong = Wrong::none) {
    return {wayfinder::Refusal{command, outcome, wrong}};
}
Answer done(CommandId command) { return {wayfinder::Response{command, Outcome::success, {}}}; }

/// A value that is no number lies in no bounds.
bool lies_in(float value, float low, float high) { return value >= low && value <= high; }

Wrong what_is_wrong(const wayfinder::Setup& setup) {
    if (setup.baud != slow && setup.baud != fast) return Wrong::baud;
    if (setup.trigger > 1) return Wrong::trigger;
    if (!lies_in(setup.sound_speed, least_sound_speed, most_sound_speed)) return Wrong::sound_speed;
    return lies_in(setup.most_range, least_range, longest_range) ? Wrong::none : Wrong::range;
}

/// `command`: that asks for it.
Answer set_setup(CommandId command, wayfinder::Setup setup, State& state) {
    const Wrong wrong = what_is_wrong(setup);
    if (wrong != Wrong::none) return refused(command, Outcome::invalid, wrong);
    setup.version = wayfinder::Setup().version;
    setup.size = wayfinder::Setup().size;
    state.setup = setup;
    return done(command);
}

Answer set_time(const wayfinder::Clock& clock) {
    using namespace std::chrono;
    const year_month_day date{year(2000 + clock.year), month(clock.month), day(clock.day)};
    if (clock.year > 99 || !date.ok() || clock.hour > 23 || clock.minute > 59 || clock.second > 59)
        return refused(CommandId::set_time, Outcome::invalid, Wrong::time);
    const auto at = sys_days(date) + hours(clock.hour) + minutes(clock.minute) + seconds(clock.second);
    Answer answer = done(CommandId::set_time);
    answer.clock = duration_cast<microseconds>(at.time_since_epoch()).count();
    return answer;
}

wayfinder::TimeResponse time_of(std::int64_t now) {
    const auto moment = doppler::moment_of(now);
    wayfinder::TimeResponse out;
    out.clock.year = static_cast<std::uint8_t>(moment.year() % 100);
    out.clock.month = static_cast<std::uint8_t>(moment.month());
    out.clock.day = static_cast<std::uint8_t>(moment.day());
    out.clock.hour = static_cast<std::uint8_t>(moment.hour());
    out.clock.minute = static_cast<std::uint8_t>(moment.minute());
    out.clock.second = static_cast<std::uint8_t>(moment.second());
    return out;
}

wayfinder::SystemResponse system_of(const Settings& settings) {
    wayfinder::SystemResponse out;
    out.frequency = static_cast<float>(settings.acoustics.frequency);
    out.firmware = firmware;
    out.fpga = 0x01000000;
    out.system_id = settings.serial_number;
    out.beam_angle = static_cast<float>(rad_to_deg(settings.acoustics.tilt));
    return out;
}

/// A NUL behind each of its three texts.
wire::Text<32> board(const char* number, const Settings& settings) {
    char text[32] = {};
    const int size = std::snprintf(text, sizeof text, "%s", number) + 1;
    std::snprintf(text + size, sizeof text - static_cast<std::size_t>(size), "A");
    std::snprintf(text + size + 2, sizeof text - static_cast<std::size_t>(size) - 2, "%06u",
                  static_cast<unsigned>(settings.serial_number));
    return {std::string_view(text, sizeof text)};
}

wayfinder::ComponentsResponse components_of(const Settings& settings) {
    wayfinder::ComponentsResponse out;
    out.board_1 = board("CPU72B-0001-00", settings);
    out.board_2 = board("XDR72B-0002-00", settings);
    out.board_3 = board("DSC72B-0003-00", settings);
    out.board_4 = board("SYS72B-0004-00", settings);
    return out;
}

Answer trigger(const State& state) {
    if (!state.pinging || state.setup.trigger == 0) return refused(CommandId::trigger, Outcome::failed);
    Answer answer = done(CommandId::trigger);
    answer.trigger = true;
    return answer;
}

Answer plain(CommandId command, State& state, const Settings& settings, std::int64_t now) {
    switch (command) {
        case CommandId::stop:
        case CommandId::start:
            state.pinging = command == CommandId::start;
            return done(command);
        case CommandId::trigger:
            return trigger(state);
        case CommandId::factory_defaults:
            if (state.pinging) return refused(command, Outcome::pinging);
            state.setup = {};
            return done(command);
        case CommandId::get_tests: {
            if (state.pinging) return refused(command, Outcome::pinging);
            wayfinder::TestsResponse out;
            out.tests.fill(1);
            return {out};
        }
        case CommandId::get_time:
            return {time_of(now)};
        case CommandId::get_system:
            return {system_of(settings)};
        case CommandId::get_components:
            return {components_of(settings)};
        case CommandId::get_features:
            return {wayfinder::FeaturesResponse{}};
        case CommandId::get_setup:
            return {wayfinder::SetupResponse{.setup = state.setup}};
        case CommandId::set_time:  // of parameters that do not fit it
            return refused(command, Outcome::invalid, Wrong::time);
        case CommandId::set_sound_speed:
            return refused(command, Outcome::invalid, Wrong::sound_speed);
        case CommandId::set_setup:
            return refused(command, Outcome::invalid);
        case CommandId::get_spectrum:
            return refused(command, state.pinging ? Outcome::pinging : Outcome::not_got);
        case CommandId::set_features:
        case CommandId::set_system:
        case CommandId::set_components:
            return refused(command, state.pinging ? Outcome::pinging : Outcome::not_set);
        case CommandId::start_update:
        case CommandId::upload:
            return refused(command, state.pinging ? Outcome::pinging : Outcome::failed);
    }
    return refused(command, Outcome::unknown);
}

}  // namespace

State state_of(const Settings& settings) {
    State state;
    state.setup.trigger = settings.software_trigger ? 1 : 0;
    state.setup.baud = settings.baud == slow_rate ? slow : fast;
    state.setup.sound_speed = static_cast<float>(settings.sound_speed);
    state.setup.most_range = static_cast<float>(settings.most_range);
    state.pinging = settings.pings_at_start;
    return state;
}

double baud_of(const wayfinder::Setup& setup) { return setup.baud == slow ? slow_rate : fast_rate; }

std::optional<Answer> obey(const wayfinder::Body& command, State& state, const Settings& settings,
                           std::int64_t now) {
    if (const auto* c = std::get_if<wayfinder::Command>(&command))
        return plain(c->command, state, settings, now);
    if (const auto* c = std::get_if<wayfinder::SetTime>(&command)) return set_time(c->clock);
    if (const auto* c = std::get_if<wayfinder::SetSetup>(&command))
        return set_setup(CommandId::set_setup, c->setup, state);
    wayfinder::Setup setup = state.setup;
    if (const auto* c = std::get_if<wayfinder::SetOlderSetup>(&command)) {
        setup.trigger = c->setup.trigger;
        setup.baud = c->setup.baud;
        setup.sound_speed = c->setup.sound_speed;
        setup.most_range = c->setup.most_range;
        return set_setup(CommandId::set_setup, setup, state);
    }
    if (const auto* c = std::get_if<wayfinder::SetSoundSpeed>(&command)) {
        setup.sound_speed = c->sound_speed;
        return set_setup(CommandId::set_sound_speed, setup, state);
    }
    return std::nullopt;
}

}  // namespace echoloop::dvl_wayfinder
