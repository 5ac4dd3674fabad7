#include "tools/echoloop/convert/bag.h"

#include <map>

#include "emulator/contract/error.h"
#include "emulator/scenario/value.h"
#include "tools/bag/bag.h"
#include "tools/capture/open.h"
#include "tools/capture/ports.h"

namespace echoloop::convert {
namespace {

/// A device of a capture: its name there, and its port.
struct Speaker {
    std::string device, port;
    bool is_first;  ///< of the port
};

/// "micron line" of a capture by echoloop is the port "line" of the device "micron"; others have the name of
/// their port.
Speaker speaker_of(const capture::PortSummary& port, bool of_ports) {
    const std::string text = port.text();
    const auto blank = text.rfind(' ');
    if (of_ports && blank != std::string::npos) return {text.substr(0, blank), text.substr(blank + 1), true};
    if (!port.key.name.empty()) return {port.key.name, "line", port.first_is_device()};
    const Address device = port.first_is_device() ? port.key.first : port.key.second;
    std::string name = "sonar";
    for (int shift = 24; shift >= 0; shift -= 8) name += "_" + std::to_string(device.ip >> shift & 255);
    return {name, std::to_string(device.port), port.first_is_device()};
}

std::map<capture::PortKey, Speaker> speakers_of(const Source& source) {
    capture::Input input(source.file);
    const auto found = capture::survey(*capture::open_capture(input));
    const capture::PortFilter filter(source.line);
    std::map<capture::PortKey, Speaker> speakers;
    for (const auto& port : found.ports) {
        if (!source.line.empty() && !filter.fits(port.key)) continue;
        speakers.emplace(port.key, speaker_of(port, found.of_ports));
    }
    if (speakers.empty() && !source.line.empty())
        throw StartError(Exit::usage, "--line: no line " + scenario::in_quotes(source.line) +
                                          " in the capture; `echoloop replay " + source.file +
                                          " --list` shows them");
    return speakers;
}

}  // namespace

Written write_bag(const Source& source, const std::filesystem::path& out) {
    if (source.file == "-")
        throw StartError(Exit::usage, "the capture is read twice; save standard input to a file");
    constexpr std::uint64_t keep_free = 1 << 20;  // bytes
    const auto speakers = speakers_of(source);
    bag::BagFile file(out, keep_free);
    file.note({{"version", ECHOLOOP_VERSION}, {"capture", source.file}});
    bag::Topics topics({}, [&](const auto& offer, const auto& make) { file.put(offer, make); });
    capture::Input input(source.file);
    const auto events = capture::open_capture(input);
    while (const auto event = events->next()) {
        const auto [key, by_first] = capture::origin_of(*event, events->of_ports());
        const auto speaker = speakers.find(key);
        if (speaker == speakers.end()) continue;
        const auto* piece = std::get_if<capture::StreamPiece>(&event->content);
        topics.bytes({.device = speaker->second.device,
                      .port = speaker->second.port,
                      .sent = by_first == speaker->second.is_first,
                      .packets = piece == nullptr,
                      .unix_time = event->time,
                      .bytes = capture::bytes_of(*event),
                      .gap = piece != nullptr && piece->gap});
    }
    topics.finish();
    file.finish();
    Written written;
    written.troubles = capture::troubles(events->counts());
    written.count = file.messages();
    if (written.count == 0)
        throw StartError(Exit::data, scenario::in_quotes(source.file) + ": no message in it");
    return written;
}

}  // namespace echoloop::convert
