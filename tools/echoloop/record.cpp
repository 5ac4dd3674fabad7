// echoloop record: what a real device and its driver say to each other, as a capture.
#include <cstdio>
#include <stdexcept>

#include "emulator/capture/recording.h"
#include "emulator/contract/error.h"
#include "emulator/replay/relay.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/json_replay.h"

namespace echoloop::cli {
namespace {

RecordingLimits limits_from(const Arguments& arguments) {
    constexpr double megabyte = 1e6;
    RecordingLimits limits;
    limits.file_bytes = static_cast<std::uint64_t>(arguments.number("--size", 0, 0, 1e9) * megabyte);
    return limits;
}

void print_start(const replay::Relay& relay, const Recording& recording) {
    std::printf("%s%s\n%s%s\n%s%s\n", padded("device", 16).c_str(), relay.device_place().c_str(),
                padded("driver", 16).c_str(), relay.driver_place().c_str(), padded("recording", 16).c_str(),
                recording.file().c_str());
    std::printf("passing bytes on both ways; Ctrl-C ends it\n");
    std::fflush(stdout);
}

void print_end(const replay::RelaySummary& passed, const RecordingSummary& recorded) {
    std::printf("%s%s\n%s%s\n", padded("from the device", 16).c_str(),
                counted(passed.from_device, "byte").c_str(), padded("from the driver", 16).c_str(),
                counted(passed.from_driver, "byte").c_str());
    if (passed.lost > 0)
        std::printf("  %s were not passed on: nobody received them\n", counted(passed.lost, "byte").c_str());
    std::printf(
        "%s%s, %s in %s%s%s\n", padded("recorded", 16).c_str(), counted(recorded.packets, "packet").c_str(),
        counted(recorded.bytes, "byte").c_str(), counted(recorded.files, "file").c_str(),
        recorded.lost == 0 ? ""
                           : ("; the disk was too slow for " + counted(recorded.lost, "more packet")).c_str(),
        recorded.stopped ? "; it stopped early, see above" : "");
}

replay::RelaySettings settings_from(const Arguments& arguments) {
    replay::RelaySettings settings{
        arguments.text("DEVICE"), arguments.text("DRIVER"), arguments.text("--name", "device"), {}};
    if (arguments.has("--duration")) settings.duration = arguments.number("--duration", 0, 0, 1e9);
    return settings;
}

int run_record(const Arguments& arguments) {
    if (!arguments.has("--out"))
        throw StartError(Exit::usage, "--out FILE is missing: name the capture to write");
    try {
        Recording recording(arguments.text("--out"), limits_from(arguments));
        replay::Relay relay(settings_from(arguments), recording);
        const bool json = arguments.has("--json");
        if (json) {
            std::printf("%s\n", relay_started_json(relay).c_str());
            std::fflush(stdout);
        } else {
            print_start(relay, recording);
        }
        relay.run();
        recording.finish();
        if (json) {
            std::printf("%s\n", relay_summary_json(relay.summary(), recording.summary()).c_str());
        } else {
            print_end(relay.summary(), recording.summary());
        }
    } catch (const std::invalid_argument& error) {
        throw StartError(Exit::usage, error.what());
    }
    return 0;
}

}  // namespace

Verb record_verb() {
    using Kind = Argument::Kind;
    return {"record",
            "record the traffic between a real device and its driver",
            {{Kind::positional,
              "DEVICE",
              "",
              "where the device is: serial:///dev/ttyUSB0:115200, tcp://192.168.2.2:4001",
              {},
              true},
             {Kind::positional,
              "DRIVER",
              "",
              "where the driver finds it: pty:/tmp/sonar, tcp-listen://...",
              {},
              true},
             {Kind::value, "--out", "FILE", "the pcapng capture to write"},
             {Kind::value, "--name", "NAME", "name of the device in the capture; default \"device\""},
             {Kind::value, "--size", "MB", "start a new file after this many megabytes"},
             {Kind::value, "--duration", "SECONDS", "end after this time"},
             {Kind::flag, "--json", "", "print one JSON line at the start and one at the end"}},
            "  echoloop record serial:///dev/ttyUSB0:115200 pty:/tmp/micron --out lake.pcapng --name micron\n"
            "  echoloop record udp://192.168.2.2:12345 udp-listen://127.0.0.1:12345 --out ping360.pcapng",
            run_record};
}

}  // namespace echoloop::cli
