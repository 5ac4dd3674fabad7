// The control socket of a run: lines of JSON in, a line of JSON back for each. It asks for faults and tells
// of them; nobody can reach it from another machine.
#pragma once

#include <memory>

#include "emulator/clock/clock.h"
#include "emulator/faults/control_line.h"
#include "emulator/faults/faults.h"
#include "emulator/run/session.h"
#include "emulator/scenario/control_place.h"

namespace echoloop {

class Control {
  public:
    using Summaries = std::function<std::vector<SessionSummary>()>;

    /// Binds the place; a socket file is the user's alone (0600) and replaces one that nobody serves. By TCP
    /// every user of the machine could ask, and every web page: so a client's first line is
    /// {"token": token()}. Throws StartError. What is referred to outlives this.
    Control(Clock& clock, const ControlPlace& place, Faults& faults, std::vector<ScenarioDevice> devices,
            Summaries summaries);
    ~Control();

    void start();
    void close();
    /// "unix:/tmp/echoloop/control".
    std::string describe() const;
    /// New for each run; "" for a socket file, which needs none.
    const std::string& token() const { return token_; }

  private:
    class Listener;
    struct Client;

    void make_room();
    Task<void> accept();
    Task<void> serve(std::shared_ptr<Client> client);
    std::string admit(Client& client, std::string_view line) const;
    std::string answer(std::string_view line);

    Clock& clock_;
    Faults& faults_;
    std::vector<ScenarioDevice> devices_;
    Summaries summaries_;
    std::string token_;
    std::unique_ptr<Listener> listener_;
    std::vector<std::weak_ptr<Client>> clients_;
};

}  // namespace echoloop
