// The page of a run for browsers: HTTP and WebSocket on a port of this machine, on a thread of its own that
// gives way to everything else. A viewer that does not read costs nothing: it is sent the latest, or nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "emulator/contract/device.h"
#include "tools/view/feed.h"
#include "tools/view/ticker.h"

namespace echoloop::view {

struct ServerOptions {
    Address address{};                              ///< port 0: the system's choice
    std::string hello;                              ///< first message to each viewer, JSON
    std::string scene;                              ///< body of GET /scene
    std::map<std::string, std::string> families{};  ///< as for Ticker
    /// Asks the run for {"status": true}, or, where `control` is true, for what a viewer asks; `answer` may
    /// be called on any thread, or never.
    std::function<void(std::string line, std::function<void(std::string)> answer)> ask;
    bool control = false;
    std::string token{};  ///< that lets a viewer in; "": a new one
};

class Server {
  public:
    /// Binds the port. `feed` outlives this. Throws StartError.
    Server(Feed& feed, ServerOptions options);
    ~Server();
    /// "http://127.0.0.1:41234/#TOKEN": who has it may look.
    std::string link() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace echoloop::view
