#include "render/scene/folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include "render/scene/fault.h"

namespace echoloop {
namespace {

namespace fs = std::filesystem;

constexpr const char* keep_inside = "put the file beside the scene and name it by a relative path";

struct Descriptor {
    int fd;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
};

/// Opens only what stat calls a regular file, and asks again once open, as the name may have been exchanged.
int open_regular(const fs::path& path, std::size_t& size, const std::string& place) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        scene_fault(place, "cannot find " + path.string() + ": " + std::strerror(errno), "check the path");
    if (!S_ISREG(status.st_mode))
        scene_fault(place, path.string() + " is not a regular file", "name a regular file");
    const int fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (fd < 0)
        scene_fault(place, "cannot open " + path.string() + ": " + std::strerror(errno),
                    "check its permissions");
    if (::fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) {
        ::close(fd);
        scene_fault(place, path.string() + " is not a regular file", "name a regular file");
    }
    size = static_cast<std::size_t>(status.st_size);
    return fd;
}

SceneFolder::Bytes read_bytes(int fd, std::size_t size, const fs::path& path, const std::string& place) {
    SceneFolder::Bytes bytes(size);
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = ::read(fd, bytes.data() + done, size - done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0)
            scene_fault(place, "cannot read " + path.string(), "check the disk and the file's permissions");
        done += static_cast<std::size_t>(got);
    }
    return bytes;
}

std::optional<int> hex(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return std::nullopt;
}

/// Percent decoding of RFC 3986; a broken escape stays as it is.
std::string decode(const std::string& uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const auto high = uri[i] == '%' && i + 2 < uri.size() ? hex(uri[i + 1]) : std::nullopt;
        const auto low = high ? hex(uri[i + 2]) : std::nullopt;
        out += low ? static_cast<char>(*high * 16 + *low) : uri[i];
        if (low) i += 2;
    }
    return out;
}

bool inside(const fs::path& folder, const fs::path& path) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

SceneFolder::SceneFolder(const fs::path& scene_file) {
    std::error_code error;
    file_ = fs::canonical(scene_file, error);
    if (error) scene_fault("", "cannot find the file: " + error.message(), "check the path of the scene");
    folder_ = file_.parent_path();
}

SceneFolder::Bytes SceneFolder::read_scene(std::size_t limit) const {
    std::size_t size = 0;
    const Descriptor file{open_regular(file_, size, "")};
    if (size > limit)
        scene_fault("", "the file has " + std::to_string(size) + " bytes, more than " + std::to_string(limit),
                    "split the scene or move its data into .bin files");
    return read_bytes(file.fd, size, file_, "");
}

SceneFolder::Bytes SceneFolder::read(const std::string& uri, std::size_t size,
                                     const std::string& place) const {
    const std::string name = decode(uri);
    if (name.empty() || name.find('\0') != std::string::npos || name.find("://") != std::string::npos)
        scene_fault(place, "\"" + uri + "\" is not a relative path", keep_inside);
    const fs::path relative(name);
    if (relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end())
        scene_fault(place, "\"" + uri + "\" leaves the scene's folder", keep_inside);
    std::error_code error;
    const fs::path path = fs::canonical(folder_ / relative, error);
    if (error) scene_fault(place, "cannot find \"" + uri + "\": " + error.message(), keep_inside);
    if (!inside(folder_, path))
        scene_fault(place, "\"" + uri + "\" is a link that leaves the scene's folder", keep_inside);
    std::size_t length = 0;
    const Descriptor file{open_regular(path, length, place)};
    if (length < size)
        scene_fault(place,
                    "\"" + uri + "\" has " + std::to_string(length) + " bytes, but byteLength says " +
                        std::to_string(size),
                    "export the scene again, the two files do not belong together");
    return read_bytes(file.fd, size, path, place);
}

}  // namespace echoloop
