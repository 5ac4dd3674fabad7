#include "emulator/run/fleet.h"

#include <algorithm>

#include "emulator/capture/recorded.h"
#include "emulator/capture/watched.h"
#include "emulator/contract/random_key.h"
#include "emulator/dataset/dataset.h"
#include "emulator/truth/device_truth.h"
#include "render/scene/clearance.h"

namespace echoloop {
namespace {

Around around_wires(const RunRecords& records, const std::string& device, Clock& clock) {
    Around recorder;
    if (records.recording != nullptr) recorder = PortRecorder(*records.recording, device);
    if (records.watch == nullptr) return recorder;
    return
        [recorder, watch = records.watch, device, &clock](std::unique_ptr<Transport> wire, const Port& port) {
            if (recorder) wire = recorder(std::move(wire), port);
            return std::make_unique<Watched>(std::move(wire), *watch, device, port.name,
                                             [&clock] { return clock.unix_time(); });
        };
}

}  // namespace

void Fleet::add(const Scenario& scenario, ScenarioDevice& entry, const RunRecords& records, bool faulty) {
    Clock& clock = shared_.clock;
    const Drivers drivers = scenario.clock == ClockMode::free ? Drivers::scripted : Drivers::outside;
    OpenPorts open = open_ports(clock, entry, drivers, around_wires(records, entry.name, clock));
    entry.config.endpoints = std::move(open.endpoints);
    DeviceConfig config = entry.config;
    config.unix_start = clock.unix_start();
    config.origin = scenario.origin;
    config.random_key = random_key(shared_.water.seed, entry.name);
    const auto make = [config, model = entry.model] { return model->make(config); };
    FaultySession* faults = nullptr;
    if (faulty)
        faults = faulty_sessions_
                     .emplace_back(std::make_unique<FaultySession>(clock, shared_.faults.of(entry.name)))
                     .get();
    const Mount& mount =
        *mounts_.emplace_back(std::make_unique<Mount>(scenario, entry, clock, shared_.steps));
    auto device = faults != nullptr ? faults->device(make) : make();
    auto transports = std::move(open.transports);
    if (faults != nullptr) transports = faults->lines(std::move(transports), device->ports(), entry);
    sessions_.push_back(std::make_unique<Session>(
        shared_.io, clock, shared_.renderers, shared_.water, entry.name, std::move(device),
        std::move(transports), [this, &mount](Time time) { return situation(mount, time); },
        [this, &mount](Time time) { return located(mount, time); }));
    let_others_see(*sessions_.back(), scenario, entry, mount, records);
    if (faults != nullptr) sessions_.back()->tell_of_pings(shared_.faults.of(entry.name));
    running_.push_back({entry.name, entry.model, std::move(open.places), {}, {}});
}

Surroundings Fleet::around(Vec3 position, const std::optional<GeoPlace>& origin) const {
    Surroundings found{.altitude = clearance_below(shared_.scene, position)};
    if (origin) found.place = place_from_enu(*origin, position);
    return found;
}

void Fleet::let_others_see(Session& session, const Scenario& scenario, const ScenarioDevice& entry,
                           const Mount& mount, const RunRecords& records) {
    if (records.truth != nullptr || records.dataset != nullptr)
        session.tell(std::make_unique<DeviceTruth>(
            records.truth, entry.name, [&mount](Time time) { return mount.body_from_sonar(time); }));
    if (entry.model->default_shot == nullptr) session.sends_no_pings();
    if (records.dataset != nullptr) session.keep_in(*records.dataset, sessions_.size() - 1);
    if (records.remarks)
        session.remark_pings(
            [this, origin = scenario.origin](Vec3 position) { return around(position, origin); });
    if (records.watch != nullptr)
        session.be_watched(*records.watch, [this](Time time) {
            return std::pair(shared_.vehicle.world_from_body(time), shared_.vehicle.motion(time));
        });
}

Located Fleet::located(const Mount& mount, Time time) const {
    const Pose world_from_body = shared_.vehicle.world_from_body(time),
               body_from_sonar = mount.body_from_sonar(time);
    return {time, world_from_body * body_from_sonar,
            together(world_from_body, shared_.vehicle.motion(time), body_from_sonar, mount.motion(time))};
}

Situation Fleet::situation(const Mount& mount, Time time) const {
    shared_.vehicle.count_if_stale(time);
    const Located sonar = located(mount, time);
    Situation situation(sonar.world_from_device);
    situation.velocity = sonar.motion.velocity, situation.turning = sonar.motion.turning;
    situation.movers = shared_.movers.at(time);
    situation.mover_motions = shared_.movers.motions(time);
    return situation;
}

void Fleet::start_mounts() {
    for (auto& mount : mounts_) mount->start();
}

void Fleet::step(Time from, Time to) {
    for (auto& mount : mounts_) mount->step(from, to);
}

void Fleet::power_up() {
    for (std::size_t i = 0; i < sessions_.size(); ++i) {
        sessions_[i]->start();
        if (!faulty_sessions_.empty()) faulty_sessions_[i]->start(*sessions_[i]);
    }
}

void Fleet::close() {
    for (auto& mount : mounts_) mount->close();
    for (auto& session : faulty_sessions_) session->close();
    for (auto& session : sessions_) session->close();
}

void Fleet::join_threads() {
    if (shared_.water.device_threads) shared_.water.device_threads->join();
}

std::vector<RunningDevice> Fleet::devices() const {
    std::vector<RunningDevice> running = running_;
    for (std::size_t i = 0; i < running.size(); ++i)
        for (const auto& transport : sessions_[i]->transports()) {
            running[i].places.push_back(transport->describe());
            const std::string open_to = transport->open_to();
            auto& all = running[i].open_to;
            if (!open_to.empty() && std::ranges::find(all, open_to) == all.end()) all.push_back(open_to);
        }
    return running;
}

std::vector<SessionSummary> Fleet::summary() const {
    std::vector<SessionSummary> all;
    for (const auto& session : sessions_) all.push_back(session->summary());
    return all;
}

std::vector<std::pair<std::string, std::uint64_t>> Fleet::sent() const {
    std::vector<std::pair<std::string, std::uint64_t>> sent;
    for (const SessionSummary& summary : summary()) sent.emplace_back(summary.name, summary.bytes_out);
    return sent;
}

std::map<std::string, PoseSummary> Fleet::mounts() const {
    std::map<std::string, PoseSummary> all;
    for (std::size_t i = 0; i < mounts_.size(); ++i)
        if (const auto one = mounts_[i]->summary()) all.emplace("mount of " + running_[i].name, *one);
    return all;
}

}  // namespace echoloop
