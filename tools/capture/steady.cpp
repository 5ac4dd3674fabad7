#include "tools/capture/steady.h"

#include <algorithm>
#include <cstdio>

namespace echoloop::capture {
namespace {

/// Packets that several processors took from one interface change places by microseconds. A guess, well above
/// that and well below what sets a clock.
constexpr double reordered = 0.01;  // s

}  // namespace

std::optional<CaptureEvent> Steady::next() {
    auto event = reader_->next();
    if (!event) return {};
    ++events_;
    double time = event->time + added_;
    const auto [found, is_new] = clocks_.try_emplace({event->interface, event->clock}, Clock{time});
    Clock& clock = found->second;
    if (clock.last - time > reordered) {
        // The second interface that notices a step does not count it again.
        if (clock.steps == steps_.steps_back) note_step(*event, clock.last - time);
        added_ += clock.last - time;
        time = clock.last;
    }
    clock = {time, steps_.steps_back};
    said_ = std::max(said_.value_or(time), time);
    event->time = *said_;
    return event;
}

void Steady::note_step(const CaptureEvent& event, double step) {
    if (steps_.steps_back++ > 0) return;
    steps_.first_step = step;
    steps_.step_place =
        event.packet != 0 ? "packet " + std::to_string(event.packet) : "message " + std::to_string(events_);
}

CaptureCounts Steady::counts() const {
    CaptureCounts counts = reader_->counts();
    counts.steps_back = steps_.steps_back;
    counts.first_step = steps_.first_step;
    counts.step_place = steps_.step_place;
    return counts;
}

std::string step_text(const CaptureCounts& counts) {
    if (counts.steps_back == 0) return {};
    char text[64];
    std::snprintf(text, sizeof text, "the clock of the file steps back by %.3g s at ", counts.first_step);
    const std::uint64_t more = counts.steps_back - 1;
    const std::string times = more == 1 ? "once more" : std::to_string(more) + " times more";
    return text + counts.step_place + (more > 0 ? ", and " + times : "") + "; no gap is made of it";
}

}  // namespace echoloop::capture
