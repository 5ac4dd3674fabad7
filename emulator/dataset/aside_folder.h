// A folder that is made aside and gets its name when it is whole. One process at a time makes it; what a
// killed one left is thrown away.
#pragma once

#include <filesystem>

namespace echoloop {

class AsideFolder {
  public:
    /// Made as ".NAME.part" beside `whole`, with the folders above it. Throws StartError.
    explicit AsideFolder(const std::filesystem::path& whole);
    /// Without finish(), nothing is left.
    ~AsideFolder();
    AsideFolder(const AsideFolder&) = delete;
    AsideFolder& operator=(const AsideFolder&) = delete;

    bool mine() const { return mine_; }  ///< false: another process is at it
    const std::filesystem::path& path() const { return aside_; }
    const std::filesystem::path& whole() const { return whole_; }
    /// Gives it its name. Throws StartError.
    void finish();

  private:
    std::filesystem::path whole_, aside_;
    int lock_ = -1;
    bool mine_ = false, done_ = false;
};

}  // namespace echoloop
