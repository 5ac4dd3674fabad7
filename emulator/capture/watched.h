// A transport whose traffic somebody looks at. It changes neither bytes nor times.
#pragma once

#include <functional>
#include <string>

#include "emulator/capture/watch.h"
#include "emulator/transport/decorator.h"

namespace echoloop {

class Watched final : public Decorator {
  public:
    /// `watch` outlives this. `unix_time`: s since 1970, by the run's clock; 0: now.
    Watched(
        std::unique_ptr<Transport> transport, Watch& watch, std::string device, std::string port,
        std::function<double()> unix_time = [] { return 0.0; });

    void start(Events events) override;
    /// Seen is what really left.
    Task<void> write(ByteView bytes, Address to) override;

  private:
    void tell(bool sent, ByteView bytes);

    Watch& watch_;
    std::string device_, port_;
    std::function<double()> unix_time_;
    bool packets_;
};

}  // namespace echoloop
