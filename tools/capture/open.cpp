#include "tools/capture/open.h"

#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"
#include "emulator/scenario/value.h"
#include "tools/capture/makers_files.h"
#include "tools/capture/message_file.h"
#include "tools/capture/ping_viewer_log.h"
#include "tools/capture/serial_log.h"
#include "tools/capture/steady.h"

namespace echoloop::capture {

namespace {

/// nullptr if it is none.
std::unique_ptr<CaptureReader> open_log(Input& input, const OpenSettings& settings) {
    if (input.is_capture()) return open_packets(input);
    for (const auto open : {open_ping_viewer_log, open_oculus, open_aris, open_xtf, open_kmall})
        if (auto file = open(input, settings)) return file;
    if (SerialLog::recognises(input)) return std::make_unique<SerialLog>(input);
    return nullptr;
}

std::unique_ptr<CaptureReader> open_file(Input& input, const OpenSettings& settings) {
    if (auto log = open_log(input, settings)) return log;
    if (const auto* family = MessageFile::recognise(input))
        return std::make_unique<MessageFile>(input, *family, settings);
    if (input.peek(1).empty())
        throw StartError(Exit::data, scenario::in_quotes(input.name()) +
                                         " is empty; a tcpdump that still runs writes late: end it first, or "
                                         "give it -U");
    throw StartError(Exit::data,
                     scenario::in_quotes(input.name()) +
                         " is no capture that can be read: neither pcap nor pcapng, nor a maker's recording, "
                         "nor lines like '12.345 < 40 30', nor messages of a known sonar");
}

}  // namespace

std::unique_ptr<CaptureReader> open_capture(Input& input, const OpenSettings& settings) {
    return std::make_unique<Steady>(open_file(input, settings), input);
}

std::unique_ptr<CaptureReader> open_if_log(Input& input) {
    auto log = open_log(input, {});
    return log == nullptr ? nullptr : std::make_unique<Steady>(std::move(log), input);
}

std::vector<std::string> troubles(const CaptureCounts& counts) {
    std::vector<std::string> out;
    if (!counts.fault.empty()) out.push_back("the capture ends early: " + counts.fault);
    if (counts.damaged_bytes > 0)
        out.push_back(std::to_string(counts.damaged_bytes) +
                      " bytes of the file are no whole record, the first at byte " +
                      std::to_string(counts.first_damage) + "; reading went on at the next good one");
    if (counts.steps_back > 0) out.push_back(step_text(counts));
    return out;
}

}  // namespace echoloop::capture
