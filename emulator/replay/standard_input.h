// Lines that a person types while a program serves other things. What they say is of no interest.
#pragma once

#include <array>
#include <functional>

#include "emulator/clock/asio.h"

namespace echoloop::replay {

class StandardInput {
  public:
    /// `line` is called for each line, on the io_context.
    StandardInput(asio::io_context& io, std::function<void()> line);
    /// Where standard input cannot be waited for (a plain file) or has ended, no line ever comes.
    void start();

  private:
    void read();

    asio::posix::stream_descriptor input_;
    std::function<void()> line_;
    std::array<char, 256> buffer_{};
};

}  // namespace echoloop::replay
