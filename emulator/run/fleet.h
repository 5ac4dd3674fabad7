// The devices of a run: for each a session, its place on the vehicle, and the faults on its lines.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/faults/faults.h"
#include "emulator/pose/mount.h"
#include "emulator/pose/movers.h"
#include "emulator/pose/vehicle.h"
#include "emulator/run/faulty_session.h"
#include "emulator/run/runtime.h"

namespace echoloop {

class Fleet {
  public:
    /// What all devices of a run share; it outlives them.
    struct Shared {
        asio::io_context& io;
        Clock& clock;
        SharedWater& water;
        Vehicle& vehicle;
        Movers& movers;
        const Scene& scene;
        Faults& faults;
        StepServer* steps;         ///< nullptr: the run is not stepped
        RenderThreads& renderers;  ///< not used before start()
    };

    explicit Fleet(const Shared& shared) : shared_(shared) {}
    Fleet(const Fleet&) = delete;
    Fleet& operator=(const Fleet&) = delete;

    /// Opens the ports of `entry` and writes their numbers into it. `scenario`: that it is of. `faulty`:
    /// faults may be asked for. Throws StartError.
    void add(const Scenario& scenario, ScenarioDevice& entry, const RunRecords& records, bool faulty);
    void start_mounts();
    void step(Time from, Time to);
    void power_up();
    /// Nothing is said from here on.
    void close();
    /// A device may still be busy with an echogram; afterwards none is.
    void join_threads();

    std::vector<RunningDevice> devices() const;
    std::vector<SessionSummary> summary() const;
    /// Bytes that each has sent.
    std::vector<std::pair<std::string, std::uint64_t>> sent() const;
    /// Of the mounts that somebody outside moves.
    std::map<std::string, PoseSummary> mounts() const;

  private:
    Located located(const Mount& mount, Time time) const;
    Situation situation(const Mount& mount, Time time) const;
    void let_others_see(Session& session, const Scenario& scenario, const ScenarioDevice& entry,
                        const Mount& mount, const RunRecords& records);
    /// What a remark says of a place; `origin`: of the world.
    Surroundings around(Vec3 position, const std::optional<GeoPlace>& origin) const;

    const Shared shared_;
    std::vector<std::unique_ptr<Mount>> mounts_;                   ///< as sessions_
    std::vector<std::unique_ptr<FaultySession>> faulty_sessions_;  ///< as sessions_, or none
    std::vector<std::unique_ptr<Session>> sessions_;
    std::vector<RunningDevice> running_;  ///< as sessions_, without their places
};

}  // namespace echoloop
