// Bytes of many messages kept for later: the first in memory, what is more in a file that has no name and is
// gone with the program. Bounded by the disk.
#pragma once

#include <cstdio>
#include <filesystem>

#include "emulator/contract/device.h"

namespace echoloop::replay {

class Store {
  public:
    /// `in_memory`: bytes that are kept there before the file is made.
    explicit Store(std::size_t in_memory = std::size_t{64} << 20) : most_(in_memory) {}
    ~Store();
    Store(const Store&) = delete;
    Store& operator=(const Store&) = delete;

    struct Handle {
        std::uint64_t at = 0;
        std::uint32_t size = 0;
    };
    /// Throws StartError (io) if the disk takes no more.
    Handle keep(ByteView bytes);
    /// Empty if the file can no longer be read.
    Bytes read(Handle handle) const;

  private:
    void open_file();

    std::size_t most_;
    Bytes memory_;
    std::FILE* file_ = nullptr;
    std::uint64_t end_ = 0;  ///< of all that is kept
};

}  // namespace echoloop::replay
