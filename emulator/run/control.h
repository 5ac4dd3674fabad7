// The control of a run: lines of JSON in, a line of JSON back for each. They ask for faults and for how it
// goes; nobody can reach its socket from another machine.
#pragma once

#include <memory>

#include "emulator/clock/clock.h"
#include "emulator/faults/control_line.h"
#include "emulator/faults/faults.h"
#include "emulator/run/session.h"
#include "emulator/scenario/control_place.h"
#include "emulator/water/render_threads.h"

namespace echoloop {

/// Who answers the lines, wherever they come from. On the thread of the wires.
class ControlDesk {
  public:
    using Summaries = std::function<std::vector<SessionSummary>()>;
    using Rendering = std::function<RenderThreads::Load()>;

    /// What is referred to outlives this.
    ControlDesk(Clock& clock, Faults& faults, std::vector<ScenarioDevice> devices, Summaries summaries,
                Rendering rendering);
    /// Without the end of the line.
    std::string answer(std::string_view line);

  private:
    Clock& clock_;
    Faults& faults_;
    std::vector<ScenarioDevice> devices_;
    Summaries summaries_;
    Rendering rendering_;
};

/// Its socket.
class Control {
  public:
    /// Binds the place; a socket file is the user's alone (0600) and replaces one that nobody serves. By TCP
    /// every user of the machine could ask, and every web page: so a client's first line is
    /// {"token": token()}. Throws StartError. What is referred to outlives this.
    Control(Clock& clock, const ControlPlace& place, ControlDesk& desk);
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

    Clock& clock_;
    ControlDesk& desk_;
    std::string token_;
    std::unique_ptr<Listener> listener_;
    std::vector<std::weak_ptr<Client>> clients_;
};

}  // namespace echoloop
