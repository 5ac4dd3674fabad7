// echoloop replay: what a capture holds, said again to a driver, at an endpoint that the user names.
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "emulator/contract/error.h"
#include "emulator/replay/answering.h"
#include "emulator/replay/replay.h"
#include "emulator/replay/stepped.h"
#include "emulator/replay/timed.h"
#include "emulator/scenario/problems.h"
#include "tools/capture/port_family.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/json_replay.h"
#include "tools/echoloop/live_view.h"
#include "tools/echoloop/replay_ports.h"
#include "tools/echoloop/replay_text.h"

namespace echoloop::cli {
namespace {

using capture::Survey;

constexpr double bits_per_byte = 10;  // 8N1

/// Many messages at one and the same time are a file without times.
void require_times(const Arguments& arguments, const Survey& survey) {
    const bool untimed =
        arguments.has("--stepped") || arguments.has("--answer") || arguments.has("--interval");
    const auto& only = survey.ports.front();
    if (untimed || survey.ports.size() > 1 || only.end > only.begin || survey.counts.steps_back > 0) return;
    if (only.first.pieces + only.second.pieces < 3) return;
    throw StartError(
        Exit::usage,
        "the file holds no times; give --interval 0.1, or --stepped to send one message for each request");
}

Survey survey_of(const Arguments& arguments) {
    const std::string file = arguments.text("CAPTURE");
    if (file == "-")
        throw StartError(Exit::usage,
                         "a replay reads its capture more than once; save standard input to a file");
    capture::Input input(file);
    const auto capture = capture::open_capture(input, settings_for_playing(arguments));
    Survey result = capture::survey(*capture);
    if (result.ports.empty() && !result.counts.fault.empty())
        throw StartError(Exit::data, scenario::in_quotes(file) + ": " + result.counts.fault);
    return result;
}

/// 0 is for steps.
double speed_of(const Arguments& arguments) {
    constexpr double slowest = 0.001, fastest = 1000;
    const bool still = arguments.has("--speed") && arguments.number("--speed", 1, 0, fastest) == 0;
    return still ? 0 : arguments.number("--speed", 1, slowest, fastest);
}

double baud_of(const Arguments& arguments, const Endpoint& endpoint) {
    constexpr double usual = 115200;
    if (endpoint.scheme == Endpoint::Scheme::serial && endpoint.baud != 0) return endpoint.baud;
    const double fallback = endpoint.scheme == Endpoint::Scheme::serial ? usual : 0;
    return arguments.number("--baud", fallback, 1, 20e6);
}

bool takes_datagrams(const Endpoint& endpoint) {
    return endpoint.scheme == Endpoint::Scheme::udp || endpoint.scheme == Endpoint::Scheme::udp_listen;
}

/// Streams must be cut into messages where each is to become a datagram.
bool becomes_datagrams(const Assignment& a) { return !a.datagrams && takes_datagrams(a.endpoint); }

SourceSettings source_settings(const Arguments& arguments, const std::vector<Assignment>& assignments) {
    SourceSettings settings;
    settings.file = arguments.text("CAPTURE");
    settings.from = arguments.number("--from", 0, 0, 1e9);
    settings.until = arguments.number("--until", 1e18, 0, 1e9);
    settings.speed = speed_of(arguments);
    settings.open = settings_for_playing(arguments);
    for (const auto& a : assignments) {
        settings.ports.push_back(a.port);
        const double baud = baud_of(arguments, a.endpoint);
        if (baud > 0) settings.ports.back().byte_time = bits_per_byte / baud;
        settings.whole_messages |= becomes_datagrams(a);
    }
    if (settings.until <= settings.from) throw StartError(Exit::usage, "--until must be later than --from");
    return settings;
}

using Mode = ReplayMode;

/// Throws StartError (usage) for modes that exclude each other.
Mode mode_of(const Arguments& arguments) {
    const bool still = speed_of(arguments) == 0;
    const bool stepped = arguments.has("--stepped") || still, answering = arguments.has("--answer");
    if (stepped && answering)
        throw StartError(
            Exit::usage,
            "--answer keeps the captured delays, so it goes with neither --stepped nor --speed 0");
    if (arguments.has("--stepped") && arguments.has("--speed") && !still)
        throw StartError(Exit::usage, "--stepped waits for a request, so it does not go with --speed");
    if (answering && arguments.has("--loop"))
        throw StartError(Exit::usage, "--answer never ends by itself, so it needs no --loop");
    return answering ? Mode::answering : stepped ? Mode::stepped : Mode::timed;
}

/// The families that the ports speak: needed where messages must be told apart.
void find_families(const Arguments& arguments, std::vector<Assignment>& assignments) {
    const auto* forced = family_asked_for(arguments);
    for (auto& a : assignments) {
        capture::Input input(arguments.text("CAPTURE"));
        const auto capture = capture::open_capture(input, settings_for_playing(arguments));
        a.port.family = forced != nullptr ? forced : capture::family_of_port(*capture, a.port.keys);
    }
}

std::unique_ptr<replay::Player> player_from(Mode mode, const Arguments& arguments,
                                            const std::vector<Assignment>& assignments) {
    SourceSettings settings = source_settings(arguments, assignments);
    const double speed = settings.speed;
    settings.whole_messages |= mode != Mode::timed;
    std::vector<replay::DriverPort> ports;
    for (const auto& a : assignments) ports.push_back({a.port.family, takes_datagrams(a.endpoint)});
    auto source = std::make_unique<CaptureSource>(std::move(settings));
    const bool loop = arguments.has("--loop");
    if (mode == Mode::answering) return std::make_unique<replay::AnsweringPlayer>(*source, ports, speed);
    if (mode == Mode::stepped) return std::make_unique<replay::SteppedPlayer>(std::move(source), ports, loop);
    return std::make_unique<replay::TimedPlayer>(std::move(source), speed, loop);
}

replay::Settings replay_settings(Mode mode, const Arguments& arguments,
                                 const std::vector<Assignment>& assignments) {
    replay::Settings settings;
    settings.steps_by_lines = mode == Mode::stepped;
    for (const auto& a : assignments)
        settings.places.push_back({to_string(a.endpoint), a.name, baud_of(arguments, a.endpoint)});
    settings.starts_at_once = arguments.text("--start", mode == Mode::answering ? "now" : "driver") == "now";
    if (arguments.has("--duration")) settings.duration = arguments.number("--duration", 0, 0, 1e9);
    return settings;
}

int list(const Arguments& arguments, const Survey& survey) {
    std::printf("%s\n", arguments.has("--json") ? ports_json(survey).c_str() : ports_text(survey).c_str());
    return 0;
}

std::vector<ShownPort> shown(const std::vector<Assignment>& assignments) {
    std::vector<ShownPort> ports;
    for (const auto& a : assignments) ports.push_back({a.name, a.port.family});
    return ports;
}

int run_replay(const Arguments& arguments) {
    LiveView live_view(arguments);
    const Survey survey = survey_of(arguments);
    warn_of_what_is_not_played(survey);
    if (arguments.has("--list")) return list(arguments, survey);
    const Mode mode = mode_of(arguments);
    auto assignments = assignments_from(arguments, survey);
    require_times(arguments, survey);
    find_families(arguments, assignments);
    auto settings = replay_settings(mode, arguments, assignments);
    settings.watch = live_view.watch();
    replay::Replay replay(player_from(mode, arguments, assignments), std::move(settings));
    auto page = live_view.serve(arguments.text("CAPTURE"), shown(assignments));
    const std::string link = page ? page->link() : "";
    const bool json = arguments.has("--json");
    if (json) {
        std::printf("%s\n", replay_started_json(assignments, replay, link).c_str());
        std::fflush(stdout);
    } else {
        print_replay_start(mode, assignments, replay, link);
    }
    replay.run();
    page.reset();
    if (json) {
        std::printf("%s\n", replay_summary_json(replay.summary(), replay.counts()).c_str());
    } else {
        print_replay_end(mode, replay.summary(), replay.counts());
    }
    return 0;
}

}  // namespace

Verb replay_verb() {
    using Kind = Argument::Kind;
    return {
        "replay",
        "play a capture back to an endpoint",
        {{Kind::positional,
          "CAPTURE",
          "",
          "pcap, pcapng, .kmall, .s7k, .jsf, .aris, .oculus, .xtf, .bin, .svlog, .sonar, .852, .81A, .31l, a "
          "serial log "
          "as text, ...; .gz of all",
          {},
          true},
         {Kind::optional, "ENDPOINT", "",
          "where to play it: pty:/tmp/sonar, tcp-listen://127.0.0.1:9090, ..."},
         {Kind::value, "--port", "NAME",
          "port of the capture to play: its name, an address, a port number, or ADDRESS:PORT"},
         {Kind::repeated, "--play", "PORT=ENDPOINT",
          "play this port at this endpoint; repeat it for several ports"},
         {Kind::flag, "--list", "", "print the ports of the capture and exit"},
         {Kind::value, "--speed", "FACTOR",
          "play this many times as fast as captured; default 1; 0: as --stepped"},
         {Kind::flag, "--stepped", "", "send one message each time the driver writes or Enter is pressed"},
         {Kind::flag, "--answer", "",
          "answer each request with what followed the most similar captured request"},
         {Kind::value, "--interval", "SECONDS", "time between messages, for a file without times"},
         {Kind::flag, "--loop", "", "repeat from the start"},
         {Kind::value, "--from", "SECONDS", "start at this time, counted from the capture's first packet"},
         {Kind::value, "--until", "SECONDS", "stop at this time"},
         {Kind::value, "--direction", "SIDE", "which side to play, device or driver", {"device", "driver"}},
         {Kind::value, "--family", "NAME", "protocol family of the requests; default: guessed"},
         {Kind::value, "--baud", "RATE", "pace the bytes like a serial line of this many bit/s"},
         {Kind::value,
          "--start",
          "WHEN",
          "start when the first driver connects, or at once",
          {"driver", "now"}},
         {Kind::value, "--duration", "SECONDS", "end after this time, even if something is left"},
         view_arguments("the replay")[0],
         view_arguments("the replay")[1],
         {Kind::flag, "--json", "", "print one JSON line at the start and one at the end"}},
        "  echoloop replay dive.pcapng pty:/tmp/echoloop/micron\n"
        "  echoloop replay dive.pcapng --list\n"
        "  echoloop replay dive.pcapng udp-listen://127.0.0.1:9092 --port 'ping360 line 1' --answer\n"
        "  echoloop replay lake.pcap udp://127.0.0.1:4000 --port 65500 --speed 2 --loop",
        run_replay};
}

}  // namespace echoloop::cli
