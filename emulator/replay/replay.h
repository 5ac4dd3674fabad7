// A player joined with the endpoints that the user named: it sends what is due and passes on what drivers
// say. Prints nothing; sends to nobody but those endpoints and who speaks to them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/capture/watch.h"
#include "emulator/replay/player.h"

namespace echoloop::replay {

/// Where a port of the capture is played.
struct Place {
    std::string endpoint;  ///< URI
    std::string name{};    ///< of the port, as a watch is told it
    double baud = 0;       ///< bit/s; 0: as fast as the endpoint takes it, a serial port at its own rate
};

struct Settings {
    std::vector<Place> places;       ///< one per port of the player
    bool starts_at_once = false;     ///< else when a driver is there, if any place can know
    bool steps_by_lines = false;     ///< a line on standard input asks for the next message
    std::optional<double> duration;  ///< s, then it ends
    Watch* watch = nullptr;          ///< sees all bytes, and outlives the replay; nullptr: nobody looks
};

struct Summary {
    std::uint64_t messages = 0, bytes = 0;  ///< handed over to the endpoints
    std::uint64_t taken = 0;                ///< bytes that were taken: somebody was there
    std::uint64_t bytes_in = 0;             ///< from drivers
    Time worst_lateness{};                  ///< of what was sent, against the player's times
    double seconds = 0;                     ///< from the driver's arrival to the end
    bool driver_came = false;
};

class Replay {
  public:
    /// Opens every endpoint. Throws StartError, std::invalid_argument (an endpoint that is none).
    Replay(std::unique_ptr<Player> player, Settings settings);
    ~Replay();

    std::vector<std::string> places() const;  ///< what they call themselves
    /// Until the player has ended and all has been sent, a signal, or the end of the time.
    void run();
    Summary summary() const;
    const PlayerCounts& counts() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace echoloop::replay
