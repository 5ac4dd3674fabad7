#include "tools/capture/steady.h"

#include <algorithm>
#include <cstdio>

namespace echoloop::capture {
namespace {

/// Packets that several processors took from one interface change places by microseconds. A guess, well above
/// that and well below what sets a clock.
constexpr double swapped_packets = 0.01;  // s
/// Pings that were worked out late stand behind later ones: up to two in a row, 0.8 s late, in 22 real KMALL
/// files. If more in a row are late, the clock was set back.
constexpr double late_measurement = 1.5;  // s
constexpr int most_late = 4;
/// Clocks that differ by more count from another beginning, such as power-up instead of 1970.
constexpr double other_beginning = 1e6;  // s

}  // namespace

std::optional<CaptureEvent> Steady::next() {
    auto event = reader_->next();
    if (!event) return {};
    ++events_;
    const auto [found, is_new] = clocks_.try_emplace({event->interface, event->clock}, Clock{});
    Clock& clock = found->second;
    double time = event->time + added_;
    if (is_new && said_) {
        const double behind = *said_ - time;
        if (behind > 0 || -behind > other_beginning) clock.lag = behind;
    }
    time += clock.lag;
    const double back = is_new ? 0 : clock.last - time;
    if (back <= swapped_packets) {
        clock.late.reset();
        clock.late_ones = 0;
    } else if (!event->clock.empty() && back <= late_measurement && clock.late_ones < most_late) {
        if (clock.late_ones++ == 0) clock.late = time;
    } else {
        // The second interface that notices a step does not count it again.
        const double step = clock.last - clock.late.value_or(time);
        if (clock.steps == steps_.steps_back) note_step(*event, step);
        added_ += step;
        time += step;
        clock.late.reset();
        clock.late_ones = 0;
    }
    clock.last = std::max(is_new ? time : clock.last, time);
    clock.steps = steps_.steps_back;
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
    if (counts.fault.empty()) counts.fault = input_.fault();
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
