#include "tools/echoloop/replay_text.h"

#include <cstdio>

#include "tools/capture/open.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/terminal.h"

namespace echoloop::cli {
namespace {

using Mode = ReplayMode;

const char* mode_text(Mode mode) {
    if (mode == Mode::answering) return "answering requests as the capture does";
    return mode == Mode::stepped ? "playing one message for each request, or for Enter" : "playing";
}

void print_requests(const replay::PlayerCounts& counts) {
    std::uint64_t unanswered = 0;
    std::string names;
    for (const auto& [name, count] : counts.unanswered) {
        unanswered += count;
        names += (names.empty() ? ": " : ", ") + name + " " + std::to_string(count);
    }
    std::printf("%s%s, %s answered, %s that the capture does not hold%s; %s of noise\n",
                padded("requests", 16).c_str(), std::to_string(counts.requests).c_str(),
                std::to_string(counts.answered).c_str(), std::to_string(unanswered).c_str(), names.c_str(),
                counted(counts.noise, "byte").c_str());
}

}  // namespace

void warn_of_what_is_not_played(const capture::Survey& survey) {
    const auto& counts = survey.counts;
    for (const auto& trouble : capture::troubles(counts)) print_warning(trouble);
    if (counts.skipped > 0) print_warning(counted(counts.skipped, "packet") + " not understood, not played");
    if (counts.incomplete > 0)
        print_warning(counted(counts.incomplete, "datagram") + " of which fragments are missing, not played");
    if (survey.cut > 0)
        print_warning(counted(survey.cut, "datagram") + " cut short by the capture, not played");
    if (survey.more_ports > 0)
        print_warning("more ports than can be kept apart; the later ones are not played");
}

void print_replay_start(ReplayMode mode, const std::vector<Assignment>& assignments,
                        const replay::Replay& replay, const std::string& view) {
    const auto places = replay.places();
    for (std::size_t i = 0; i < assignments.size(); ++i) {
        const auto& a = assignments[i];
        std::printf("%s%s\n", padded(a.name, 16).c_str(), places[i].c_str());
        std::printf("  %s of %s in %s s\n", counted(a.pieces, "piece").c_str(),
                    counted(a.bytes, "byte").c_str(), plain(a.end - a.begin, 3).c_str());
    }
    if (!view.empty()) std::printf("%s%s\n", padded("view", 16).c_str(), view.c_str());
    std::printf("%s; Ctrl-C ends it\n", mode_text(mode));
    std::fflush(stdout);
}

void print_replay_end(ReplayMode mode, const replay::Summary& s, const replay::PlayerCounts& counts) {
    if (!s.driver_came && s.messages == 0) {
        std::printf("nobody connected; nothing was played\n");
        return;
    }
    std::printf("%s%s of %s in %s s, the worst %s ms late\n", padded("played", 16).c_str(),
                counted(s.messages, "message").c_str(), counted(s.bytes, "byte").c_str(),
                plain(s.seconds, 3).c_str(), plain(to_seconds(s.worst_lateness) * 1e3, 1).c_str());
    if (s.taken < s.bytes)
        std::printf("  %s were lost, because nobody read them\n", counted(s.bytes - s.taken, "byte").c_str());
    std::printf("%s%s\n", padded("from drivers", 16).c_str(), counted(s.bytes_in, "byte").c_str());
    if (mode != ReplayMode::timed) print_requests(counts);
}

}  // namespace echoloop::cli
