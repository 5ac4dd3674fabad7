#include "tools/echoloop/run_summary.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "tools/echoloop/common.h"

namespace echoloop::cli {
namespace {

/// Why most late pings were late, and what helps.
std::string remedy(const SessionSummary& s) {
    if (2 * s.late_renderings > s.late_pings)
        return "rendering takes too long; use fewer sonars, a simpler scene or render: {pixels: 0.5}";
    if (2 * s.late_wakings > s.late_pings)
        return "other programs or the host used the processors; see --realtime and docs/timing.md";
    return "this machine is too busy or too slow for it";
}

std::string in_ms(Time time) { return plain(to_seconds(time) * 1e3, 1) + " ms"; }

std::string late(const SessionSummary& s) {
    if (s.late_pings == 0) return "none late";
    return std::to_string(s.late_pings) + " late (" + std::to_string(s.late_renderings) +
           " because of rendering, " + std::to_string(s.late_wakings) +
           " because the program was woken late), the worst by " + in_ms(s.worst_lateness) + ": " + remedy(s);
}

std::string punctuality(const SessionSummary& s) {
    if (!s.is_sonar) return counted(s.messages_out, "message") + "; it is no sonar and sends no pings";
    return counted(s.pings, "ping") + ", " + late(s);
}

/// Of all sonars together, as far as punctuality() tells it.
SessionSummary sum_of(const std::vector<SessionSummary>& sessions) {
    SessionSummary all;
    for (const auto& s : sessions) {
        all.pings += s.pings;
        all.late_pings += s.late_pings;
        all.late_renderings += s.late_renderings;
        all.late_wakings += s.late_wakings;
        all.worst_lateness = std::max(all.worst_lateness, s.worst_lateness);
    }
    return all;
}

/// Nothing where nothing is missing.
std::string not_taken(std::uint64_t count, const char* thing, const char* fate) {
    if (count == 0) return "";
    return "; " + counted(count, thing) + " " + fate + ", because the driver did not read them";
}

}  // namespace

void print_summary(const std::vector<SessionSummary>& sessions) {
    const auto ms = [](Time time) { return plain(to_seconds(time) * 1e3, 2) + " ms"; };
    for (const auto& s : sessions) {
        std::printf("%s%s\n", padded(s.name, 16).c_str(), punctuality(s).c_str());
        if (s.pings > 0)
            std::printf("  time after they were due: median %s, 99th percentile %s\n",
                        ms(s.median_lateness).c_str(), ms(s.p99_lateness).c_str());
        if (s.spared_pings > 0)
            std::printf(
                "  rendering did not keep up: %s without late echoes of the ping before, %s of them drawn "
                "with a "
                "quarter of the pixels\n",
                counted(s.spared_pings, "ping").c_str(), std::to_string(s.coarse_pings).c_str());
        std::printf("  from the driver: %s, %s understood, %s refused, %s of noise skipped\n",
                    counted(s.bytes_in, "byte").c_str(), counted(s.device.messages, "message").c_str(),
                    std::to_string(s.device.rejected).c_str(),
                    counted(s.device.skipped_bytes, "byte").c_str());
        std::printf("  to the driver: %s, at most %s at once in the queue%s%s\n",
                    counted(s.bytes_out, "byte").c_str(), counted(s.most_waiting, "message").c_str(),
                    not_taken(s.bytes_lost, "byte", "lost").c_str(),
                    not_taken(s.dropped, "message", "dropped").c_str());
        if (s.empty_datagrams > 0)
            std::printf("  ignored: %s\n", counted(s.empty_datagrams, "empty datagram").c_str());
        if (s.targets_refused > 0)
            std::printf("  not sent: %s to addresses that are none of the peers\n",
                        counted(s.targets_refused, "datagram").c_str());
    }
    const auto sonars = std::ranges::count(sessions, true, &SessionSummary::is_sonar);
    if (sonars > 1)
        std::printf("%s%s\n", padded("all sonars", 16).c_str(), punctuality(sum_of(sessions)).c_str());
}

void demand_punctuality(const std::vector<SessionSummary>& sessions) {
    for (const auto& s : sessions)
        if (s.late_pings > 0 || s.dropped > 0 || s.bytes_lost > 0)
            throw StartError(Exit::late, s.name + ": " + counted(s.late_pings, "late ping") + ", " +
                                             counted(s.dropped, "dropped message") + " and " +
                                             counted(s.bytes_lost, "lost byte") +
                                             ", and --fail-late allows none; " +
                                             (s.late_pings > 0 ? remedy(s) : "the driver must read faster"));
}

void print_poses(const std::string& name, const PoseSummary& s, const char* untold) {
    std::printf("%s%s from %s, %llu refused%s, %s, %s with a stale pose%s%s\n", padded(name, 16).c_str(),
                counted(s.accepted, "pose").c_str(), s.place.c_str(),
                static_cast<unsigned long long>(s.refused),
                s.refused == 0 ? "" : (" (the last: " + s.last_refusal + ")").c_str(),
                counted(s.jumps, "jump").c_str(), counted(s.stale_pings, "ping").c_str(),
                s.accepted == 0 ? ": nobody said where " : "", s.accepted == 0 ? untold : "");
}

void print_steps(const StepSummary& s) {
    std::printf("%s%s to %s s of the run, %llu refused%s\n", padded("clock", 16).c_str(),
                counted(s.steps, "step").c_str(), plain(to_seconds(s.run_time), 3).c_str(),
                static_cast<unsigned long long>(s.refused),
                s.refused == 0 ? "" : (" (the last: " + s.last_refusal + ")").c_str());
}

void print_stolen(double seconds) {
    if (seconds > 0)
        std::printf("%sits host took %s s of processor time\n", padded("machine", 16).c_str(),
                    plain(seconds, 2).c_str());
}

}  // namespace echoloop::cli
