// Makes the maker's .81A, .852 and .31L files from the words of a line: each reply becomes a shot, its header
// told by the command before it. Writes bytes in memory; opens no file and knows no clock.
#pragma once

#include <optional>

#include "protocols/imagenex/codec.h"

namespace echoloop::imagenex {

enum class ShotFormat { shot_852, shot_81a, shot_31l };

class ShotWriter {
  public:
    explicit ShotWriter(ShotFormat format) : format_(format) {}

    /// The settings of the replies to come.
    void command(const SwitchCommand& command) { command_ = command; }
    /// Whether a .852 or .81A file has a place for it: not for the 1000 samples of an 872.
    static bool has_place(const Reply& reply) { return reply.data.size() <= 500; }
    /// The shot of a reply that has a place; `unix_time` in s, UTC. Not for .31L files.
    wire::Bytes shot(const Reply& reply, double unix_time);
    /// The shot of an 831L's IMX; only for .31L files, which have no place for an IPX.
    wire::Bytes shot(const PipeReply& reply, double unix_time);

  private:
    wire::Bytes shot_852(const Reply& reply, double unix_time) const;
    wire::Bytes shot_81a(const Reply& reply, double unix_time);

    ShotFormat format_;
    SwitchCommand command_;
    std::size_t last_shot_ = 0;          ///< bytes
    std::optional<double> last_time_{};  ///< s, of the 831L's reply before
};

}  // namespace echoloop::imagenex
