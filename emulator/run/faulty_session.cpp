#include "emulator/run/faulty_session.h"

#include "emulator/contract/options.h"
#include "emulator/transport/driver_lines.h"

namespace echoloop {
namespace {

/// One for each ping.
bool has_events_of_its_own(FaultKind kind) {
    return kind == FaultKind::stuck_motor || kind == FaultKind::frozen_image;
}

bool is_tcp(const Transport& line) {
    const Wire::Kind kind = line.wire().kind;
    return kind == Wire::Kind::tcp_server || kind == Wire::Kind::tcp_client;
}

/// bit/s; 0 if it has none.
double own_rate(const DeviceConfig& config) {
    return config.options.contains("baud") ? number(config.options, "baud") : 0;
}

}  // namespace

FaultySession::FaultySession(Clock& clock, DeviceFaults& faults)
    : clock_(clock),
      faults_(faults),
      schedule_(clock, faults,
                [this](const Fault& fault, int id, bool begins) { change(fault, id, begins); }),
      power_(clock) {}

std::unique_ptr<Device> FaultySession::device(FaultyDevice::Make make) {
    auto device = std::make_unique<FaultyDevice>(std::move(make), faults_);
    device_ = device.get();
    return device;
}

std::vector<std::unique_ptr<Transport>> FaultySession::lines(
    std::vector<std::unique_ptr<Transport>> transports, const std::vector<Port>& ports,
    const ScenarioDevice& device) {
    MessageTraits traits{true, find_checksums(device.model->family)};
    for (std::size_t i = 0; i < transports.size(); ++i) {
        traits.stream = ports[i].kind == Port::Kind::stream;
        const bool serial = transports[i]->wire().kind == Wire::Kind::serial;
        traits.line_rate = serial ? own_rate(device.config) : 0;
        auto* const own_lines = dynamic_cast<DriverLines*>(transports[i].get());
        traits.several = own_lines != nullptr && ports[i].drivers > 1;
        const auto faulty = [&](std::unique_ptr<Transport> open) -> std::unique_ptr<Transport> {
            auto line = std::make_unique<Faulty>(clock_, std::move(open), faults_, ports[i].name, traits);
            lines_.push_back(line.get());
            return line;
        };
        if (own_lines != nullptr)
            own_lines->put_around(faulty);
        else
            transports[i] = faulty(std::move(transports[i]));
    }
    faults_.on_change([this] {
        for (Faulty* line : lines_) line->faults_changed();
    });
    return transports;
}

void FaultySession::start(Session& session) {
    session_ = &session;
    session.around_hearing(
        [this](Time now) { device_->about_to_hear(now); },
        [this](Actions actions, Time now) { return device_->answered(std::move(actions), now); });
    schedule_.start();
}

void FaultySession::close() {
    closed_ = true;
    schedule_.close();
    power_.cancel();
}

void FaultySession::change(const Fault& fault, int id, bool begins) {
    if (closed_ || has_events_of_its_own(fault.kind)) return;
    record(fault, id, begins);
    if (fault.kind == FaultKind::reboot)
        asio::co_spawn(clock_.io(), reboot(from_seconds(number(fault.parameters, "off"))),
                       Serving(faults_.name()));
    for (Faulty* line : lines_)
        if (fault.port.empty() || fault.port == line->port()) change_line(*line, fault, begins);
}

void FaultySession::change_line(Faulty& line, const Fault& fault, bool begins) {
    if (fault.kind == FaultKind::unplug) begins ? line.unplug() : line.plug();
    if (fault.kind == FaultKind::half_open) begins ? line.forget() : line.reset_forgotten();
    if (fault.kind == FaultKind::reset) line.reset();
}

/// A network device without power takes no connection; back again, it knows none of the old ones and resets
/// them. A serial line stays, with nobody at its end.
Task<void> FaultySession::reboot(Time off) {
    const std::uint64_t cut = ++power_cuts_;
    session_->cut_power([this] { device_->cut_power(); });
    for (Faulty* line : lines_) {
        line->forget();
        line->cut_off();
        if (is_tcp(*line)) line->unplug();
    }
    const Time on = clock_.now() + off;
    while (clock_.now() < on && !closed_ && cut == power_cuts_) co_await power_.until(on);
    if (closed_ || cut != power_cuts_) co_return;
    for (Faulty* line : lines_) {
        if (is_tcp(*line)) line->plug();
        line->reset_forgotten();
    }
    session_->power_up();
}

void FaultySession::record(const Fault& fault, int id, bool begins) {
    FaultEvent event;
    event.kind = fault.kind;
    event.id = id;
    if (faults_.heard_ping() > 0) event.ping = faults_.heard_ping();
    event.is_end = !begins;
    if (!row_of(fault.kind).momentary) event.details = {{"phase", std::string(begins ? "begin" : "end")}};
    for (AskedFault& asked : faults_.asked())
        if (event.is_end && asked.id == id && fault.kind == FaultKind::unplug)
            event.details.emplace_back("messages",
                                       static_cast<std::int64_t>(std::exchange(asked.swallowed, 0)));
    faults_.record(clock_.now(), {faults_.name(), fault.port}, event);
}

}  // namespace echoloop
