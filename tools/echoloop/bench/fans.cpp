#include "tools/echoloop/bench/fans.h"

#include <algorithm>
#include <ctime>
#include <string>

#include "emulator/contract/model.h"
#include "emulator/run/runtime.h"
#include "tools/echoloop/bench/child_process.h"

namespace echoloop::bench {
namespace {

std::string scenario_of(std::size_t fans, std::size_t heads) {
    std::string text =
        "scene: scenes/manifold.glb\n"
        "water: {temperature: 8, salinity: 35, ph: 8}\n"
        "vehicle: {pose: {position: [-12, 0, -4], rpy_deg: [0, 0, 0]}}\n"
        "devices:\n";
    for (std::size_t i = 1; i <= fans; ++i) {
        const std::string number = std::to_string(i), address = "127.9.9." + number;
        text += "  - name: fan" + number +
                "\n    model: r2sonic-2024\n"
                "    mount: {position: [0.5, 0, -0.1], rpy_deg: [0, 20, 0]}\n"
                "    endpoints: [\"udp-listen://" +
                address + ":45500\", \"udp://" + address +
                ":45400\"]\n"
                "    options: {projector: wide, range: 40, ping_rate: 10, image_height: 500}\n";
    }
    for (std::size_t i = 1; i <= heads; ++i) {
        const std::string number = std::to_string(i);
        text += "  - name: head" + number + "\n    model: nmea-echosounder\n    mount: {rpy_deg: [0, 0, " +
                std::to_string(360 * i / heads) + "]}\n    endpoints: [\"udp://127.9.10." + number +
                ":45400\"]\n    options: {range: 40, rate: 10}\n";
    }
    return text;
}

double processor_time() {
    timespec t{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

FansFigures run_fans(std::size_t fans, std::size_t heads, double seconds,
                     const std::filesystem::path& example) {
    Runtime runtime(parse_scenario(scenario_of(fans, heads), example, {}, models()));
    const double before = processor_time();  // plans are made and trees are built: its threads have warmed up
    runtime.run(seconds);
    FansFigures figures;
    figures.fans = fans, figures.heads = heads, figures.seconds = seconds;
    figures.cpu = processor_time() - before;
    for (const SessionSummary& s : runtime.summary()) {
        const auto pings = static_cast<double>(s.pings), late = static_cast<double>(s.late_pings);
        figures.pings += pings, figures.late += late;
        if (s.name.starts_with("head")) figures.head_pings += pings, figures.late_head_pings += late;
        figures.spared += static_cast<double>(s.spared_pings);
        figures.coarse += static_cast<double>(s.coarse_pings);
        figures.p99_lateness = std::max(figures.p99_lateness, to_seconds(s.p99_lateness));
        figures.worst_lateness = std::max(figures.worst_lateness, to_seconds(s.worst_lateness));
    }
    return figures;
}

}  // namespace

FansFigures measure_fans(std::size_t fans, std::size_t heads, double seconds,
                         const std::filesystem::path& example) {
    return in_child_process<FansFigures>([&] { return run_fans(fans, heads, seconds, example); });
}

}  // namespace echoloop::bench
