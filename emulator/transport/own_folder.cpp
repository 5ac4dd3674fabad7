#include "emulator/transport/own_folder.h"

#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "emulator/contract/error.h"

namespace echoloop {
namespace fs = std::filesystem;
namespace {

std::string user_name(uid_t user) {
    const passwd* const entry = ::getpwuid(user);
    return entry != nullptr ? entry->pw_name : "number " + std::to_string(user);
}

bool anybody_may_make(const fs::path& folder) {
    struct stat parent {};
    const fs::path absolute = fs::absolute(folder).lexically_normal();
    return ::stat(absolute.parent_path().c_str(), &parent) == 0 && (parent.st_mode & S_IWOTH) != 0;
}

}  // namespace

fs::path place_of_ones_own() {
    const char* const told = std::getenv("XDG_RUNTIME_DIR");
    const std::string user = std::to_string(::getuid());
    for (const fs::path& login : {fs::path(told == nullptr ? "" : told), fs::path("/run/user") / user})
        if (login.is_absolute() && ::access(login.c_str(), W_OK | X_OK) == 0) return login / "echoloop";
    return "/tmp/echoloop-" + user;
}

void make_own_folder(const fs::path& folder, const std::string& what, const std::string& instead) {
    if (folder.empty()) return;
    std::error_code ec;
    fs::create_directories(folder, ec);
    const bool denied = ec == std::errc::permission_denied || ec == std::errc::read_only_file_system;
    if (ec)
        throw StartError(denied ? Exit::no_permission : Exit::cannot_create,
                         folder.string() + ": directory for " + what + " cannot be made: " + ec.message() +
                             "; name a directory that you may write, e.g. " + instead);
    struct stat found {};
    if (::lstat(folder.c_str(), &found) != 0 || !anybody_may_make(folder)) return;
    if (found.st_uid == ::geteuid() || (found.st_uid == 0 && !S_ISLNK(found.st_mode))) return;
    throw StartError(Exit::no_permission, folder.string() + ": directory for " + what +
                                              (S_ISLNK(found.st_mode) ? " is a link" : " was") +
                                              " made by the user " + user_name(found.st_uid) +
                                              ", who could exchange what is in it; name another, e.g. " +
                                              instead);
}

}  // namespace echoloop
