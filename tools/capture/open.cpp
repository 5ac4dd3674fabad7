#include "tools/capture/open.h"

#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"
#include "emulator/scenario/value.h"
#include "tools/capture/message_file.h"
#include "tools/capture/ping_viewer_log.h"
#include "tools/capture/serial_log.h"
#include "tools/capture/steady.h"

namespace echoloop::capture {

bool is_log(Input& input) {
    return input.is_capture() || PingViewerLog::recognises(input) || SerialLog::recognises(input);
}

namespace {

std::unique_ptr<CaptureReader> open_file(Input& input, const OpenSettings& settings) {
    if (input.is_capture()) return open_packets(input);
    if (PingViewerLog::recognises(input)) return std::make_unique<PingViewerLog>(input);
    if (SerialLog::recognises(input)) return std::make_unique<SerialLog>(input);
    if (const auto* family = MessageFile::recognise(input))
        return std::make_unique<MessageFile>(input, *family, settings.interval);
    if (input.peek(1).empty())
        throw StartError(Exit::data, scenario::in_quotes(input.name()) +
                                         " is empty; a tcpdump that still runs writes late: end it first, or "
                                         "give it -U");
    throw StartError(Exit::data,
                     scenario::in_quotes(input.name()) +
                         " is no capture that can be read: neither pcap nor pcapng, nor a log of Ping "
                         "Viewer, nor lines like '12.345 < 40 30', nor messages of a known sonar");
}

}  // namespace

std::unique_ptr<CaptureReader> open_capture(Input& input, const OpenSettings& settings) {
    return std::make_unique<Steady>(open_file(input, settings));
}

CaptureCounts read_capture(Input& input, const CaptureEvents& events) {
    const auto capture = open_capture(input);
    while (const auto event = capture->next()) {
        if (const auto* datagram = std::get_if<Datagram>(&event->content)) {
            events.datagram(event->time, *datagram);
        } else {
            events.stream(event->time, std::get<StreamPiece>(event->content));
        }
    }
    const CaptureCounts counts = capture->counts();
    if (counts.packets == 0 && !counts.fault.empty())
        throw StartError(Exit::data, scenario::in_quotes(input.name()) +
                                         " is no capture that can be read: " + counts.fault);
    return counts;
}

}  // namespace echoloop::capture
