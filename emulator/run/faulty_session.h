// Everything about one device of a run that things can go wrong with: its lines, itself, and when. It joins
// them and makes no fault.
#pragma once

#include "emulator/faults/faulty.h"
#include "emulator/faults/faulty_device.h"
#include "emulator/faults/schedule.h"
#include "emulator/run/session.h"
#include "emulator/scenario/scenario.h"

namespace echoloop {

class FaultySession {
  public:
    /// `faults` outlives this.
    FaultySession(Clock& clock, DeviceFaults& faults);
    ~FaultySession() { close(); }

    /// The device for the session, made by `make` now and after each loss of power.
    std::unique_ptr<Device> device(FaultyDevice::Make make);
    /// The lines for the session, one per port of `device`.
    std::vector<std::unique_ptr<Transport>> lines(std::vector<std::unique_ptr<Transport>> transports,
                                                  const std::vector<Port>& ports,
                                                  const ScenarioDevice& device);
    /// Behind the session's start.
    void start(Session& session);
    void close();

  private:
    void change(const Fault& fault, int id, bool begins);
    void change_line(Faulty& line, const Fault& fault, bool begins);
    Task<void> reboot(Time off);
    void record(const Fault& fault, int id, bool begins);

    Clock& clock_;
    DeviceFaults& faults_;
    FaultSchedule schedule_;
    Alarm power_;  ///< rings when it comes back
    FaultyDevice* device_ = nullptr;
    std::vector<Faulty*> lines_;
    Session* session_ = nullptr;
    std::uint64_t power_cuts_ = 0;
    bool closed_ = false;
};

}  // namespace echoloop
