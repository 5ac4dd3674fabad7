// A scenario come to life: scene, renderer, one session per device, until a signal or the end of the time.
// Prints nothing; the command line does.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/faults/labels.h"
#include "emulator/run/open_ports.h"
#include "emulator/run/session.h"
#include "emulator/scenario/scenario.h"

namespace echoloop {

/// A device that is up, and where.
struct RunningDevice {
    std::string name;
    const Model* model = nullptr;
    std::vector<PortPlace> ports;
    std::vector<std::string> places;   ///< what its transports call themselves
    std::vector<std::string> open_to;  ///< networks of other machines, as Transport::open_to(); none twice
};

class BackgroundFile;
class KeptScene;
class Recording;
class TruthFile;
class Watch;
struct PoseSummary;
struct StepSummary;

/// How much a run asks of the machine to be on time: what anybody may ask, or what needs rights.
enum class Punctuality { ordinary, real_time };

/// What a run writes beside the bytes on the wire; nullptr: not asked for. All outlive the runtime.
struct RunRecords {
    Recording* recording = nullptr;    ///< gets the traffic of every port
    bool remarks = false;              ///< in the recording each ping says where its sonar was
    TruthFile* truth = nullptr;        ///< gets what is really there at every ping
    BackgroundFile* labels = nullptr;  ///< gets a line for every fault that is made
    Watch* watch = nullptr;            ///< sees every ping that it wants, and all bytes
    bool live_faults = false;          ///< ask() may ask for them, though there is no control place
};

class Runtime {
  public:
    /// Loads the scene, makes the renderer and opens every endpoint; nothing is said on any of them yet.
    /// In real time, what is made here renders before all ordinary programs. Throws SceneError, StartError or
    /// std::runtime_error, and then has left nothing behind.
    /// `kept`: of runs before; nullptr: everything is made anew.
    explicit Runtime(const Scenario& scenario, RunRecords records = {},
                     Punctuality punctuality = Punctuality::ordinary, KeptScene* kept = nullptr);
    ~Runtime();

    /// As it was given, with the numbers of ports that it left to the program.
    const Scenario& scenario() const;
    std::vector<RunningDevice> devices() const;  ///< as in scenario()
    std::shared_ptr<const Scene> scene() const;
    std::size_t triangles() const;
    std::string renderer() const;  ///< e.g. "OSMesa, 4.5 (Core Profile) Mesa 22.3.6, llvmpipe"

    /// Powers the devices up and serves them until SIGINT, SIGTERM or `duration` seconds: of real time, or of
    /// the run where the clock is stepped or free. Stepped, the first step powers the devices up; free, the
    /// duration is the run's only end.
    void run(std::optional<double> duration = {});
    /// What a client of the control place would say; from any thread, during run(). `answer` is called with
    /// what it would hear, on the thread of the wires, or never where the run is over.
    void ask(std::string line, std::function<void(std::string)> answer);
    /// By a signal, before its time was over.
    bool interrupted() const;
    std::vector<SessionSummary> summary() const;
    /// What a client says there first; "" if nothing is asked for.
    std::string control_token() const;
    /// Of the faults that were made, by device; empty if none could be.
    std::map<std::string, FaultCounts> faults() const;
    /// What came from outside about the vehicle; empty if nothing is asked from there.
    std::optional<PoseSummary> poses() const;
    /// Of the objects that somebody outside moves.
    std::map<std::string, PoseSummary> objects() const;
    /// Empty unless the clock is stepped.
    std::optional<StepSummary> steps() const;
    /// s of processor time that the host of a virtual machine took during the run; 0 if the clock is stepped,
    /// since nothing is late then.
    double stolen_seconds() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace echoloop
