// Makes the maker's .81A and .852 files from the words of a line: each reply becomes a shot, its header told
// by the command before it. Writes bytes in memory; opens no file and knows no clock.
#pragma once

#include "protocols/imagenex/codec.h"

namespace echoloop::imagenex {

enum class ShotFormat { shot_852, shot_81a };

class ShotWriter {
  public:
    explicit ShotWriter(ShotFormat format) : format_(format) {}

    /// The settings of the replies to come.
    void command(const SwitchCommand& command) { command_ = command; }
    /// The shot of a reply; `unix_time` in s, UTC.
    wire::Bytes shot(const Reply& reply, double unix_time);

  private:
    wire::Bytes shot_852(const Reply& reply, double unix_time) const;
    wire::Bytes shot_81a(const Reply& reply, double unix_time);

    ShotFormat format_;
    SwitchCommand command_;
    std::size_t last_shot_ = 0;  ///< bytes
};

}  // namespace echoloop::imagenex
