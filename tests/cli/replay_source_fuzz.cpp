// libFuzzer: any bytes as a capture that is played: by time, step by step and by requests, faster and over
// and over. The first byte chooses how. A player must not want to speak for ever at one moment.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "emulator/contract/error.h"
#include "emulator/replay/answering.h"
#include "emulator/replay/stepped.h"
#include "emulator/replay/timed.h"
#include "tools/capture/port_family.h"
#include "tools/echoloop/replay_source.h"

using namespace echoloop;
using namespace echoloop::cli;

namespace {

struct Play {
    bool loop, whole_messages, datagrams;
    double speed, from;
    std::uint8_t how;
};

SourceSettings settings_of(const std::string& file, const capture::Survey& survey, const Play& play) {
    SourceSettings settings;
    settings.file = file;
    for (const auto& found : survey.ports) {
        PlayedPort port;
        port.keys = {{found.key, found.first_is_device()}};
        port.drivers = found.drivers;
        capture::Input input(file);
        port.family = capture::family_of_port(*capture::open_capture(input, settings.open), port.keys);
        port.byte_time = 1e-3;
        settings.ports.push_back(std::move(port));
        if (settings.ports.size() == 3) break;
    }
    settings.from = play.from;
    settings.speed = play.speed;
    settings.whole_messages = play.whole_messages;
    return settings;
}

std::unique_ptr<replay::Player> player_of(SourceSettings settings, const Play& play) {
    std::vector<replay::DriverPort> ports;
    for (const auto& port : settings.ports) ports.push_back({port.family, play.datagrams});
    settings.whole_messages |= play.how != 0;
    auto source = std::make_unique<CaptureSource>(settings);
    if (play.how == 1) return std::make_unique<replay::AnsweringPlayer>(*source, ports, play.speed);
    if (play.how == 2) return std::make_unique<replay::SteppedPlayer>(std::move(source), ports, play.loop);
    return std::make_unique<replay::TimedPlayer>(std::move(source), play.speed, play.loop);
}

/// Everything that is due at the time of the next message, again and again.
void listen(replay::Player& player, std::size_t size) {
    const std::size_t most = 16 + 4 * size;  // messages that so many bytes can hold
    for (int moments = 0; moments < 50 && player.due(); ++moments) {
        const Time now = *player.due();
        std::size_t said = 0;
        for (; player.due() && *player.due() <= now; ++said) {
            if (said > most) std::abort();
            player.take();
        }
    }
}

void play_all(const std::string& file, ByteView bytes, const Play& play) {
    capture::Input input(file);
    const auto survey = capture::survey(*capture::open_capture(input));
    if (survey.ports.empty()) return;
    const auto player = player_of(settings_of(file, survey, play), play);
    player->arrived(Time(0));
    listen(*player, bytes.size());
    player->heard(0, bytes, Time(1000));
    player->stepped(Time(2000));
    player->reconnected(0);
    listen(*player, bytes.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const std::uint8_t choice = data[0];
    const Play play{(choice & 1) != 0,         (choice & 2) != 0,
                    (choice & 4) != 0,         choice & 8 ? 1000.0 : 0.5,
                    choice & 16 ? 0.001 : 0.0, static_cast<std::uint8_t>((choice >> 5) % 3)};
    const int descriptor = ::memfd_create("capture", MFD_CLOEXEC);
    const ByteView bytes(data + 1, size - 1);
    if (descriptor < 0 ||
        ::write(descriptor, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
        return 0;
    try {
        play_all("/proc/self/fd/" + std::to_string(descriptor), bytes, play);
    } catch (const StartError&) {
    }
    ::close(descriptor);
    return 0;
}
