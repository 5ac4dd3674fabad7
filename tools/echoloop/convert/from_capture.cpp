#include "tools/echoloop/convert/from_capture.h"

#include <fstream>
#include <functional>
#include <map>

#include "emulator/contract/error.h"
#include "emulator/replay/message_reader.h"
#include "emulator/scenario/value.h"
#include "tools/capture/open.h"
#include "tools/capture/ports.h"
#include "tools/echoloop/watched_capture.h"

namespace echoloop::convert {
namespace {

using capture::PortKey;
using scenario::in_quotes;

/// The ports that the user means, and whether the device is `first` there.
std::map<PortKey, bool> chosen_ports(const Source& source) {
    if (source.file == "-")
        throw StartError(Exit::usage, "the capture is read twice; save standard input to a file");
    capture::Input input(source.file);
    cli::WatchedCapture watched(input, capture::open_capture(input, {.as_sent = true}));
    const auto found = capture::survey(watched);
    std::map<PortKey, bool> ports;
    const capture::PortFilter filter(source.line);
    for (const auto& port : found.ports) {
        if (!source.line.empty() && !filter.fits(port.key)) continue;
        const auto end = source.line.empty() ? std::nullopt : filter.end_is_first(port.key);
        ports[port.key] = end.value_or(port.first_is_device());
    }
    if (ports.empty() && !source.line.empty())
        throw StartError(Exit::usage, "--line: no line " + in_quotes(source.line) +
                                          " in the capture; `echoloop replay " + source.file +
                                          " --list` shows them");
    return ports;
}

using Each = std::function<void(const PortKey&, const Heard&)>;

/// What the devices at these ports say.
std::vector<std::string> for_messages(const Source& source, const inspect::Family& family,
                                      const std::map<PortKey, bool>& ports, const Each& each) {
    capture::Input input(source.file);
    const auto file =
        std::make_unique<cli::WatchedCapture>(input, capture::open_capture(input, {.as_sent = true}));
    std::map<PortKey, replay::MessageReader> readers;
    double last = 0;
    while (const auto event = file->next()) {
        const auto [key, by_first] = capture::origin_of(*event, file->of_ports());
        const auto port = ports.find(key);
        if (port == ports.end() || port->second != by_first) continue;
        const auto* datagram = std::get_if<capture::Datagram>(&event->content);
        if (datagram != nullptr && datagram->cut) continue;
        // Parts of an ARIS' frame and KMALL's datagrams keep their bounds; frames of others may go on.
        const bool keeps_bounds = datagram != nullptr && (family.framing == inspect::Framing::datagram ||
                                                          family.name == std::string_view("aris"));
        auto& reader = readers.try_emplace(key, replay::MessageReader(&family, keeps_bounds)).first->second;
        last = event->time;
        const auto take = [&](const replay::WholeMessage& message) {
            if (keeps_bounds || !message.name.empty()) each(key, {event->time, message.bytes, message.name});
        };
        const auto* piece = std::get_if<capture::StreamPiece>(&event->content);
        if (piece != nullptr && piece->gap) reader.finish(take);
        reader.add(capture::bytes_of(*event), take);
    }
    for (auto& [key, reader] : readers)
        reader.finish([&, &port = key](const replay::WholeMessage& message) {
            if (!message.name.empty()) each(port, {last, message.bytes, message.name});
        });
    return capture::troubles(file->counts());
}

/// Frames of a Ping Viewer's log and of Cerulean's programs have one form; which family they are of says
/// their content.
const inspect::Family& family_of(const Source& source, const Format& format, std::map<PortKey, bool>& ports) {
    const inspect::Family* const family = inspect::find_family(format.family);
    std::map<PortKey, std::size_t> spoken;
    for_messages(source, *family, ports, [&](const PortKey& key, const Heard& heard) {
        const bool counts = format.holds.empty() ? !heard.name.empty() : heard.name == format.holds;
        spoken[key] += counts ? 1 : 0;
    });
    std::erase_if(ports, [&](const auto& port) { return spoken[port.first] == 0; });
    return *family;
}

}  // namespace

Written write_recording(const Source& source, const Format& format, const std::filesystem::path& out) {
    auto ports = chosen_ports(source);
    const inspect::Family& family = family_of(source, format, ports);
    if (ports.empty())
        throw StartError(Exit::data, in_quotes(source.file) + ": no " + std::string(format.contents));
    if (ports.size() > 1 && source.line.empty()) {
        std::string names;
        for (const auto& [key, first] : ports)
            names +=
                (names.empty() ? "" : ", ") + in_quotes(capture::PortSummary{key, {}, {}, 0, 0, {}}.text());
        throw StartError(Exit::usage, "the capture holds several lines; choose one with --line: " + names);
    }
    const auto recording = format.make();
    std::ofstream file(out, std::ios::binary);
    for_messages(source, family, ports, [&](const auto&, const Heard& heard) { recording->look(heard); });
    recording->begin(file);
    Written written;
    written.troubles = for_messages(source, family, ports,
                                    [&](const auto&, const Heard& heard) { recording->add(heard, file); });
    recording->end(file);
    if (recording->count() == 0)
        throw StartError(Exit::data, in_quotes(source.file) + ": no " + std::string(format.contents));
    if (!file.flush()) throw std::runtime_error("cannot write all of it");
    written.count = recording->count();
    written.lost = recording->lost();
    return written;
}

}  // namespace echoloop::convert
