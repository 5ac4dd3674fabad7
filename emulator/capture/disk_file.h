// A file that grows by whole pieces and says why it cannot grow. It never waits for room, and never shares
// the file with another writer.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace echoloop {

// Of a thread that writes to a disk:
inline constexpr std::size_t enough_to_write = 1 << 20;        ///< bytes
inline constexpr std::chrono::milliseconds longest_wait(500);  ///< for more; what a kill -9 may lose

class DiskFile {
  public:
    /// Overwrites `file`, of which every one begins with `begins`. Throws StartError if it cannot be made, if
    /// somebody writes to it already, or if it holds something else.
    DiskFile(std::filesystem::path file, std::string_view begins);
    ~DiskFile() { close(); }
    DiskFile(const DiskFile&) = delete;
    DiskFile& operator=(const DiskFile&) = delete;

    /// Why the piece could not be written; "" if it was. If not, the file ends with the one before: half a
    /// piece would make the whole file suspect. `keep_free`: bytes of the disk that are left to others.
    std::string append(std::string_view piece, std::uint64_t keep_free);
    void close();
    bool is_open() const { return descriptor_ >= 0; }
    std::uint64_t size() const { return size_; }  ///< bytes written

  private:
    [[noreturn]] void refuse(const std::string& why);

    std::filesystem::path file_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// On the calling thread, a pipe that nobody reads any more and a limit on the size of files are from now on
/// reasons why not, and no signals that end the program.
void take_no_signals_for_files();

}  // namespace echoloop
