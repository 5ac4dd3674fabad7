#include "emulator/dataset/aside_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "emulator/contract/error.h"

namespace echoloop {
namespace {

namespace fs = std::filesystem;

StartError cannot(const std::string& what, const fs::path& path, const std::error_code& why) {
    return {Exit::io, "cannot " + what + " " + path.string() + ": " + why.message()};
}

/// "dives/" is "dives".
fs::path without_slash(const fs::path& path) {
    const fs::path plain = path.lexically_normal();
    return plain.has_filename() ? plain : plain.parent_path();
}

}  // namespace

AsideFolder::AsideFolder(const fs::path& whole)
    : whole_(without_slash(whole)),
      aside_(whole_.parent_path() / ("." + whole_.filename().string() + ".part")) {
    std::error_code error;
    fs::create_directories(aside_, error);
    if (error) throw cannot("make", aside_, error);
    lock_ = ::open(aside_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0) throw cannot("open", aside_, {errno, std::generic_category()});
    mine_ = ::flock(lock_, LOCK_EX | LOCK_NB) == 0;
    if (!mine_) return;
    for (const auto& left : fs::directory_iterator(aside_, error)) fs::remove_all(left.path(), error);
    if (error) throw cannot("clear", aside_, error);
}

AsideFolder::~AsideFolder() {
    if (mine_ && !done_) {
        std::error_code ignored;
        fs::remove_all(aside_, ignored);
    }
    if (lock_ >= 0) ::close(lock_);
}

void AsideFolder::finish() {
    std::error_code error;
    fs::rename(aside_, whole_, error);
    if (error) throw cannot("make", whole_, error);
    done_ = true;
}

}  // namespace echoloop
