#include "emulator/devices/micron-echosounder/echosounder.h"

#include <utility>

#include "emulator/devices/family/tritech/padbt.h"

namespace echoloop::micron_echosounder {
namespace {

std::vector<std::string> lines(const Settings& settings, std::optional<double> depth) {
    const std::string line = reading(settings, depth);
    return line.empty() ? std::vector<std::string>{} : std::vector{line};
}

}  // namespace

std::string reading(const Settings& settings, std::optional<double> depth) {
    if (!depth && settings.no_echo == NoEcho::silent) return {};
    const double without = settings.no_echo == NoEcho::maximum ? settings.sounding.range : 0;
    const double metres = depth.value_or(without);
    return settings.format ? altimeter::write_line({*settings.format, metres}) : tritech::padbt(metres);
}

Echosounder::Echosounder(const Settings& settings, std::vector<echosounder::Wiring> wiring)
    : TalkingSounder(
          settings.sounding, std::move(wiring),
          [settings](std::optional<double> depth, Time) { return lines(settings, depth); },
          settings.free_running) {}

Actions Echosounder::received(const Received& data, Time now) {
    for (const std::uint8_t byte : data.bytes) {
        if (byte != 'Z' && byte != 'F') {
            ++counters_.skipped_bytes;
            continue;
        }
        ++counters_.messages;
        if (byte == 'Z')
            ask(now);
        else
            run_freely(now);
    }
    return take_actions();
}

}  // namespace echoloop::micron_echosounder
