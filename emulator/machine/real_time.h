// What a run that was asked to be on time claims of the machine beside its own threads' turns.
#pragma once

#include <optional>

#include "emulator/machine/kernel_workers.h"
#include "emulator/scenario/scenario.h"
#include "emulator/machine/standstills.h"

namespace echoloop {

/// For the start and the end of a run.
struct RealTimeSummary {
    bool needs_workers = false;  ///< some of its lines are pseudo-terminals or serial ports
    std::size_t workers = 0;     ///< of the kernel, which go before ordinary programs; 0: not permitted
    Standstills::Summary standstills;
};

class RealTime {
  public:
    /// Throws StartError with the remedy if real time is not permitted.
    explicit RealTime(const Scenario& scenario);
    Standstills& standstills() { return standstills_; }
    RealTimeSummary summary() const;

  private:
    Standstills standstills_;
    std::optional<KernelWorkers> workers_;  ///< empty: nothing for them to carry
};

}  // namespace echoloop
