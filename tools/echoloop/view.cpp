// echoloop view: what a capture holds, on a page, at the pace at which it was captured.
#include <chrono>
#include <csignal>
#include <cstdio>

#include "emulator/clock/asio.h"
#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"
#include "tools/capture/port_family.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/live_view.h"
#include "tools/echoloop/replay_ports.h"
#include "tools/echoloop/replay_source.h"

namespace echoloop::cli {
namespace {

using Steady = std::chrono::steady_clock;

/// A port of the capture, as it is played and as it is shown.
struct PortOfView {
    PlayedPort played;
    ShownPort shown;
    bool packets = false;
};

std::vector<PortOfView> ports_of(const Arguments& arguments, double& begin) {
    const std::string file = arguments.text("CAPTURE");
    if (file == "-")
        throw StartError(Exit::usage, "a capture is read more than once; save standard input to a file");
    capture::Input input(file);
    const auto capture = capture::open_capture(input, settings_for_playing(arguments));
    const capture::Survey survey = capture::survey(*capture);
    if (survey.ports.empty())
        throw StartError(Exit::data, scenario::in_quotes(file) + ": " +
                                         (survey.counts.fault.empty() ? "holds nothing that can be shown"
                                                                      : survey.counts.fault));
    begin = survey.begin;
    const auto* forced = family_asked_for(arguments);
    std::vector<PortOfView> ports;
    for (const capture::PortSummary& summary : survey.ports) {
        PortOfView port;
        port.played.keys[summary.key] = summary.first_is_device();
        port.packets = summary.key.kind == capture::PortKind::udp;
        capture::Input again(file);
        const auto reader = capture::open_capture(again, settings_for_playing(arguments));
        port.shown = {summary.text(),
                      forced != nullptr ? forced : capture::family_of_port(*reader, port.played.keys)};
        ports.push_back(std::move(port));
    }
    return ports;
}

/// Hands on what was said when its time has come, once somebody looks.
class Show {
  public:
    Show(LiveView& view, CaptureSource& source, const std::vector<PortOfView>& ports, double begin,
         double speed, bool loop)
        : view_(view),
          source_(source),
          ports_(ports),
          begin_(begin),
          speed_(speed),
          loop_(loop),
          signals_(io_, SIGINT, SIGTERM, SIGHUP),
          alarm_(io_) {}

    void run() {
        signals_.async_wait([this](error_code, int) { io_.stop(); });
        asio::co_spawn(io_, play(), Serving("view"));
        io_.run();
    }

  private:
    Task<void> play() {
        constexpr std::chrono::milliseconds look_again(50);
        while (!view_.is_looked_at()) co_await wait_until(Steady::now() + look_again);
        do {
            const auto start = Steady::now();
            bool any = false;
            while (const auto said = source_.next()) {
                any = true;
                const std::chrono::duration<double> after(to_seconds(said->time) / speed_);
                co_await wait_until(start + std::chrono::duration_cast<Steady::duration>(after));
                const PortOfView& port = ports_[said->port];
                view_.watch()->bytes({.device = port.shown.name,
                                      .port = "",
                                      .sent = said->by_device,
                                      .packets = port.packets,
                                      .bytes = said->bytes,
                                      .unix_time = begin_ + to_seconds(said->time)});
            }
            source_.rewind();
            if (!any) break;
        } while (loop_);
        std::printf("The end of the capture; the page stays. Ctrl-C ends it.\n");
        std::fflush(stdout);
    }

    Task<void> wait_until(Steady::time_point when) {
        if (when <= Steady::now()) co_return;
        error_code ec;
        alarm_.expires_at(when);
        co_await alarm_.async_wait(into(ec));
    }

    LiveView& view_;
    CaptureSource& source_;
    const std::vector<PortOfView>& ports_;
    double begin_, speed_;
    bool loop_;
    asio::io_context io_;
    asio::signal_set signals_;
    asio::steady_timer alarm_;
};

int run_view(const Arguments& arguments) {
    constexpr double slowest = 0.001, fastest = 1000;
    LiveView view(arguments, true);
    double begin = 0;
    const std::vector<PortOfView> ports = ports_of(arguments, begin);
    SourceSettings settings;
    settings.file = arguments.text("CAPTURE");
    settings.from = arguments.number("--from", 0, 0, 1e9);
    settings.open = settings_for_playing(arguments);
    std::vector<ShownPort> shown;
    for (const PortOfView& port : ports) {
        settings.ports.push_back(port.played);
        shown.push_back(port.shown);
    }
    CaptureSource source(settings);
    const auto page = view.serve(settings.file, shown);
    if (arguments.has("--json")) {
        std::printf("{\"event\": \"started\", \"view\": \"%s\"}\n", page->link().c_str());
    } else {
        std::printf("%s%s\n", padded("view", 16).c_str(), page->link().c_str());
        for (const PortOfView& port : ports)
            std::printf(
                "%s%s\n",
                padded(port.shown.family == nullptr ? "?" : std::string(port.shown.family->name), 16).c_str(),
                port.shown.name.c_str());
        std::printf("It begins when the link is opened. Ctrl-C ends it.\n");
    }
    std::fflush(stdout);
    Show(view, source, ports, begin + settings.from, arguments.number("--speed", 1, slowest, fastest),
         arguments.has("--loop"))
        .run();
    return 0;
}

}  // namespace

Verb view_verb() {
    using Kind = Argument::Kind;
    return {
        "view",
        "show a capture on a page in a browser",
        {{Kind::positional,
          "CAPTURE",
          "",
          "pcap, pcapng, .kmall, .s7k, .jsf, .aris, .oculus, .xtf, .bin, .svlog, .sonar, .852, .81A, .31l, a "
          "serial "
          "log as text, ...; .gz of all",
          {},
          true},
         view_arguments("the capture")[1],
         {Kind::value, "--speed", "FACTOR", "show it this many times as fast as captured; default 1"},
         {Kind::flag, "--loop", "", "repeat from the start"},
         {Kind::value, "--from", "SECONDS", "start at this time, counted from the capture's first packet"},
         {Kind::value, "--interval", "SECONDS", "time between messages, for a file without times"},
         {Kind::value, "--family", "NAME", "protocol family of all ports; default: guessed"},
         {Kind::flag, "--json", "", "print one JSON line at the start"}},
        "  echoloop view dive.pcapng\n"
        "  echoloop view survey.kmall --speed 4 --loop",
        run_view};
}

}  // namespace echoloop::cli
