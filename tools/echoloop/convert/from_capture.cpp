#include "tools/echoloop/convert/from_capture.h"

#include <fstream>
#include <functional>
#include <map>
#include <utility>

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

/// Who spoke at a port.
struct LineSpeaker {
    PortKey port;
    bool is_device = true;
    friend auto operator<=>(const LineSpeaker&, const LineSpeaker&) = default;
};
using Each = std::function<void(const LineSpeaker&, const Heard&)>;

/// What the devices at these ports say, and what is said to them.
std::vector<std::string> for_messages(const Source& source, const inspect::Family& family,
                                      const std::map<PortKey, bool>& ports, const Each& each) {
    capture::Input input(source.file);
    const auto file =
        std::make_unique<cli::WatchedCapture>(input, capture::open_capture(input, {.as_sent = true}));
    std::map<LineSpeaker, replay::MessageReader> readers;
    std::map<LineSpeaker, std::string> comments;
    double last = 0;
    while (const auto event = file->next()) {
        const auto [key, by_first] = capture::origin_of(*event, file->of_ports());
        const auto port = ports.find(key);
        if (port == ports.end()) continue;
        const LineSpeaker speaker{key, port->second == by_first};
        const auto* datagram = std::get_if<capture::Datagram>(&event->content);
        if (datagram != nullptr && datagram->cut) continue;
        // Parts of an ARIS' frame and KMALL's datagrams keep their bounds; frames of others may go on.
        const bool keeps_bounds = datagram != nullptr && (family.framing == inspect::Framing::datagram ||
                                                          family.name == std::string_view("aris"));
        auto& reader =
            readers.try_emplace(speaker, replay::MessageReader(&family, keeps_bounds)).first->second;
        last = event->time;
        std::string& comment = comments[speaker];
        if (!event->comment.empty()) comment = event->comment;
        const auto take = [&](const replay::WholeMessage& message) {
            if (keeps_bounds || !message.name.empty())
                each(speaker, {event->time, message.bytes, message.name, std::exchange(comment, {})});
        };
        const auto* piece = std::get_if<capture::StreamPiece>(&event->content);
        if (piece != nullptr && piece->gap) reader.finish(take);
        reader.add(capture::bytes_of(*event), take);
    }
    for (auto& [speaker, reader] : readers)
        reader.finish([&, &who = speaker](const replay::WholeMessage& message) {
            if (!message.name.empty()) each(who, {last, message.bytes, message.name});
        });
    return capture::troubles(file->counts());
}

/// Which family the frames are of says their content: Ping Viewer's and Cerulean's have one form.
const inspect::Family& family_of(const Source& source, const Format& format, std::map<PortKey, bool>& ports) {
    const inspect::Family* const family = inspect::find_family(format.family);
    std::map<PortKey, std::size_t> spoken;
    for_messages(source, *family, ports, [&](const LineSpeaker& speaker, const Heard& heard) {
        const bool counts = format.holds.empty() ? !heard.name.empty() : heard.name == format.holds;
        spoken[speaker.port] += speaker.is_device && counts ? 1 : 0;
    });
    std::erase_if(ports, [&](const auto& port) { return spoken[port.first] == 0; });
    return *family;
}

/// What is written: a family at its ports.
struct Chosen {
    const Format* format = nullptr;
    const inspect::Family* family = nullptr;
    std::map<PortKey, bool> ports{};
};

Chosen choose(const Source& source, const std::vector<Format>& kinds, const std::string& nothing) {
    const auto all = chosen_ports(source);
    Chosen chosen;
    std::string names;
    std::size_t lines = 0;
    for (const Format& format : kinds) {
        auto ports = all;
        const inspect::Family& family = family_of(source, format, ports);
        lines += ports.size();
        for (const auto& [key, first] : ports)
            names +=
                (names.empty() ? "" : ", ") + in_quotes(capture::PortSummary{key, {}, {}, 0, 0, {}}.text());
        if (chosen.ports.empty() && !ports.empty()) chosen = {&format, &family, std::move(ports)};
    }
    if (lines == 0) throw StartError(Exit::data, nothing);
    if (lines > 1 && source.line.empty())
        throw StartError(Exit::usage, "the capture holds several lines; choose one with --line: " + names);
    return chosen;
}

}  // namespace

Written write_recording(const Source& source, const std::vector<Format>& kinds,
                        const std::filesystem::path& out) {
    std::string nothing;
    for (const Format& format : kinds)
        nothing +=
            (nothing.empty() ? in_quotes(source.file) + ": no " : " and no ") + std::string(format.contents);
    const Chosen chosen = choose(source, kinds, nothing);
    const auto recording = chosen.format->make();
    const auto read = [&](auto device_said) {
        return for_messages(source, *chosen.family, chosen.ports,
                            [&](const LineSpeaker& speaker, const Heard& heard) {
                                if (speaker.is_device)
                                    device_said(heard);
                                else
                                    recording->asked(heard);
                            });
    };
    std::ofstream file(out, std::ios::binary);
    read([&](const Heard& heard) { recording->look(heard); });
    recording->begin(file);
    Written written;
    written.troubles = read([&](const Heard& heard) { recording->add(heard, file); });
    recording->end(file);
    if (recording->count() == 0) throw StartError(Exit::data, nothing);
    if (!file.flush()) throw std::runtime_error("cannot write all of it");
    written.count = recording->count();
    written.lost = recording->lost();
    return written;
}

}  // namespace echoloop::convert
