#include "render/gl/library_copy.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <string>

namespace echoloop::gl {
namespace {

/// A limit on the size of files holds for those in memory, too, and ends a program that goes beyond.
bool may_be_as_long_as(off_t size) {
    rlimit limit{};
    return ::getrlimit(RLIMIT_FSIZE, &limit) == 0 &&
           (limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= static_cast<rlim_t>(size));
}

bool copy_all(int from, int to) {
    struct stat status {};
    if (::fstat(from, &status) != 0 || !may_be_as_long_as(status.st_size)) return false;
    off_t done = 0;
    while (done < status.st_size)
        if (::sendfile(to, from, &done, static_cast<std::size_t>(status.st_size - done)) <= 0) return false;
    return true;
}

/// A descriptor of a copy in memory, which names the library in /proc/self/maps; -1 if none can be had.
int copy_in_memory(const std::string& path) {
    const int from = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (from < 0) return -1;
    int to = ::memfd_create(path.substr(path.rfind('/') + 1).c_str(), MFD_CLOEXEC);
    if (to >= 0 && !copy_all(from, to)) {
        ::close(to);
        to = -1;
    }
    ::close(from);
    return to;
}

}  // namespace

void* load_copy(void* handle) {
    link_map* map = nullptr;
    if (::dlinfo(handle, RTLD_DI_LINKMAP, static_cast<void*>(&map)) != 0) return nullptr;
    const int copy = copy_in_memory(map->l_name);
    if (copy < 0) return nullptr;
    void* loaded = ::dlopen(("/proc/self/fd/" + std::to_string(copy)).c_str(), RTLD_NOW | RTLD_LOCAL);
    // Of one that is loaded the descriptor stays open: the loader knows libraries by their paths, too, and
    // another copy must not get this one's.
    if (loaded == nullptr) ::close(copy);
    return loaded;
}

}  // namespace echoloop::gl
