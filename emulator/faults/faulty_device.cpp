#include "emulator/faults/faulty_device.h"

#include <algorithm>

namespace echoloop {
namespace {

/// The levels of `from` in as many beams and bins as `to` has.
void show_again(const Echogram& from, Echogram& to) {
    const std::size_t beams = to.beams(), bins = to.shot.bins;
    if (from.beams() == 0 || from.shot.bins == 0) return;
    for (std::size_t beam = 0; beam < beams; ++beam) {
        const auto row = from.beam(beam * from.beams() / beams);
        for (std::size_t bin = 0; bin < bins; ++bin)
            to.values[beam * bins + bin] = row[bin * from.shot.bins / bins];
    }
}

}  // namespace

FaultyDevice::FaultyDevice(Make make, DeviceFaults& faults)
    : make_(std::move(make)), faults_(faults), device_(make_()), ports_(device_->ports()) {}

void FaultyDevice::cut_power() {
    before_ = counters();
    device_.reset();
    last_pan_.reset();
}

Actions FaultyDevice::started(Time now) {
    if (!device_) device_ = make_();
    for (const auto& [port, rate] : rates_) device_->line_rate(port, rate);
    return with_faults(device_->started(now), now);
}

Actions FaultyDevice::received(const Received& data, Time now) {
    return device_ ? with_faults(device_->received(data, now), now) : Actions{};
}

Actions FaultyDevice::woken(Time now) { return device_ ? with_faults(device_->woken(now), now) : Actions{}; }

Actions FaultyDevice::located(std::span<const Located> places, Time now) {
    return device_ ? with_faults(device_->located(places, now), now) : Actions{};
}

void FaultyDevice::reconnected(std::size_t port) {
    if (device_) device_->reconnected(port);
}

Actions FaultyDevice::connected(std::size_t port, Address peer, Time now) {
    return device_ ? with_faults(device_->connected(port, peer, now), now) : Actions{};
}

Actions FaultyDevice::disconnected(std::size_t port, Address peer, Time now) {
    return device_ ? with_faults(device_->disconnected(port, peer, now), now) : Actions{};
}

void FaultyDevice::line_rate(std::size_t port, double rate) {
    rates_[port] = rate;
    if (device_) device_->line_rate(port, rate);
}

void FaultyDevice::about_to_hear(Time now) {
    shown_ = Image::passed;
    for (const AskedFault& asked : faults_.asked())
        if (asked.fault.kind == FaultKind::frozen_image) shown_ = Image::kept;
    faults_.each(FaultKind::frozen_image, now, [&](AskedFault& asked) {
        if (!image_) return;
        shown_ = Image::frozen;
        FaultEvent event;
        event.kind = FaultKind::frozen_image;
        event.id = asked.id;
        event.ping = faults_.heard_ping();
        faults_.record(now, {faults_.name()}, event);
    });
}

Actions FaultyDevice::heard(const Echogram& echogram, Time now) {
    if (!device_) return {};
    if (shown_ == Image::frozen) {
        Echogram shown = echogram;
        show_again(*image_, shown);
        return device_->heard(shown, now);
    }
    image_.reset();
    if (shown_ == Image::kept) image_ = echogram;
    return device_->heard(echogram, now);
}

Actions FaultyDevice::with_faults(Actions actions, Time now) {
    if (actions.ping) {
        ++pings_;
        stick(actions.ping->shot, now);
    }
    return actions;
}

void FaultyDevice::stick(Shot& shot, Time now) {
    bool stuck = false;
    faults_.each(FaultKind::stuck_motor, now, [&](AskedFault& asked) {
        stuck = true;
        if (!stuck_at_) stuck_at_ = last_pan_.value_or(shot.pan);
        FaultEvent event;
        event.kind = FaultKind::stuck_motor;
        event.id = asked.id;
        event.ping = pings_;
        event.details = {{"said", rad_to_deg(shot.pan)}, {"is", rad_to_deg(*stuck_at_)}};
        faults_.record(now, {faults_.name()}, event);
    });
    if (!stuck) stuck_at_.reset();
    if (stuck_at_) shot.pan = *stuck_at_;
    last_pan_ = shot.pan;
}

DeviceCounters FaultyDevice::counters() const {
    if (!device_) return before_;
    const DeviceCounters now = device_->counters();
    return {before_.messages + now.messages, before_.rejected + now.rejected,
            before_.skipped_bytes + now.skipped_bytes, before_.pings + now.pings};
}

}  // namespace echoloop
