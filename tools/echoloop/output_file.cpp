#include "tools/echoloop/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "emulator/contract/error.h"
#include "emulator/scenario/value.h"

namespace echoloop::cli {
namespace {

std::filesystem::path temporary_name(const std::filesystem::path& file) {
    return file.parent_path() / ("." + file.filename().string() + "." + std::to_string(::getpid()) + ".part");
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
    throw StartError(Exit::cannot_create, "cannot create " + scenario::in_quotes(file.string()) + ": " + why);
}

}  // namespace

void require_creatable(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) refuse(file, "it is a folder; add a file name");
    const auto temporary = temporary_name(file);
    const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (fd < 0) {
        const std::string reason = std::strerror(errno);
        refuse(file, reason + "; choose a folder that exists and that you may write to");
    }
    ::close(fd);
    ::unlink(temporary.c_str());
}

void write_whole(const std::filesystem::path& file,
                 const std::function<void(const std::filesystem::path&)>& write) {
    const auto temporary = temporary_name(file);
    try {
        write(temporary);
        std::filesystem::rename(temporary, file);
    } catch (const std::runtime_error& error) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw StartError(Exit::io,
                         "cannot write " + scenario::in_quotes(file.string()) + ": " + error.what());
    }
}

}  // namespace echoloop::cli
