// A port at whose other end a driver of the scenario is: it says what was written for it, and takes whatever
// it gets. No place of the machine is opened, so that any number of runs can go on at once.
#pragma once

#include <string>
#include <vector>

#include "emulator/clock/clock.h"
#include "emulator/contract/driver_script.h"
#include "emulator/transport/transport.h"

namespace echoloop {

class ScriptedLine final : public CountingTransport {
  public:
    /// `lines`: of this port. `clock` outlives this.
    ScriptedLine(Clock& clock, Wire wire, std::vector<DriverLine> lines);
    ~ScriptedLine() override { close(); }

    /// The driver is there from the first moment to the last.
    void start(Events events) override;
    Task<void> write(ByteView bytes, Address to) override;
    void close() override;
    std::string describe() const override { return "a driver of the scenario"; }
    Wire wire() const override { return wire_; }

  private:
    Task<void> speak();

    Clock& clock_;
    Alarm alarm_;
    Wire wire_;
    std::vector<DriverLine> lines_;
    Events events_;
    bool closed_ = false;
};

}  // namespace echoloop
