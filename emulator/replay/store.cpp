#include "emulator/replay/store.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "emulator/contract/error.h"

namespace echoloop::replay {
namespace {

[[noreturn]] void fail(const std::filesystem::path& folder) {
    throw StartError(Exit::io, "a temporary file in " + folder.string() + ": " + std::strerror(errno) +
                                   "; play a part of the capture with --from and --until, or name a folder "
                                   "with more room in TMPDIR");
}

}  // namespace

Store::~Store() {
    if (file_ != nullptr) std::fclose(file_);
}

void Store::open_file() {
    const auto folder = std::filesystem::temp_directory_path();
    std::string name = (folder / "echoloop-replay-XXXXXX").string();
    const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor < 0) fail(folder);
    ::unlink(name.c_str());
    file_ = ::fdopen(descriptor, "w+b");
    if (file_ == nullptr) fail(folder);
}

Store::Handle Store::keep(ByteView bytes) {
    const Handle handle{end_, static_cast<std::uint32_t>(bytes.size())};
    if (file_ == nullptr && memory_.size() + bytes.size() <= most_) {
        memory_.insert(memory_.end(), bytes.begin(), bytes.end());
    } else {
        if (file_ == nullptr) open_file();
        if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size())
            fail(std::filesystem::temp_directory_path());
    }
    end_ += bytes.size();
    return handle;
}

Bytes Store::read(Handle handle) const {
    Bytes bytes(handle.size);
    if (bytes.empty()) return bytes;
    if (handle.at < memory_.size()) {
        std::memcpy(bytes.data(), memory_.data() + handle.at, bytes.size());
        return bytes;
    }
    const auto offset = static_cast<off_t>(handle.at - memory_.size());
    const bool good = file_ != nullptr && ::fseeko(file_, offset, SEEK_SET) == 0 &&
                      std::fread(bytes.data(), 1, bytes.size(), file_) == bytes.size();
    if (!good) bytes.clear();
    return bytes;
}

}  // namespace echoloop::replay
