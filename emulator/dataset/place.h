// Where the files of a data set go: counts them, and says why one cannot be written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "emulator/capture/disk_file.h"

namespace echoloop {

/// A file of a data set could not be written: the file and the reason.
class DatasetFault : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class DatasetPlace {
  public:
    /// `keep_free`: bytes of the disk that are left to others.
    DatasetPlace(std::filesystem::path root, std::uint64_t keep_free)
        : root_(std::move(root)), keep_free_(keep_free) {}

    /// A file as a whole; `name` is relative to the root, with folders that are made. Throws DatasetFault.
    void put(const std::string& name, std::string_view bytes);
    std::uint64_t bytes() const { return bytes_; }

  private:
    friend class DatasetStream;
    [[noreturn]] static void fail(const std::filesystem::path& file, const std::string& why);
    std::filesystem::path file(const std::string& name);

    std::filesystem::path root_, made_;  ///< made_: the folder that is known to be there
    std::uint64_t keep_free_, bytes_ = 0;
};

/// A file that grows.
class DatasetStream {
  public:
    /// Throws DatasetFault.
    DatasetStream(DatasetPlace& place, const std::string& name);
    /// Throws DatasetFault.
    void append(std::string_view bytes);
    std::uint64_t size() const { return file_.size(); }

  private:
    DatasetPlace& place_;
    std::filesystem::path path_;
    DiskFile file_;
};

}  // namespace echoloop
