// Stands between a real device and its driver: passes bytes on unchanged and at once, both ways, and records
// them as if the device had been emulated. It understands no message.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "emulator/capture/recording.h"

namespace echoloop::replay {

struct RelaySettings {
    std::string device, driver;      ///< URIs
    std::string name = "device";     ///< of the device; its port is called "<name> line" in the recording
    std::optional<double> duration;  ///< s, then it ends
};

struct RelaySummary {
    std::uint64_t from_device = 0, from_driver = 0;  ///< bytes
    std::uint64_t lost = 0;  ///< bytes that the other side did not take: nobody was there, or too slow
};

class Relay {
  public:
    /// Opens both ends. Throws StartError, std::invalid_argument (an endpoint that is none).
    Relay(RelaySettings settings, Recording& recording);
    ~Relay();

    std::string device_place() const;  ///< what they call themselves
    std::string driver_place() const;
    /// Until a signal or the end of the time.
    void run();
    RelaySummary summary() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace echoloop::replay
