#include "emulator/devices/family/nortek/login.h"

namespace echoloop::nortek_console {
namespace {

const std::string ask_password = "Please enter password:\r\n", ask_user = "Username: ";

}  // namespace

std::string Login::welcome() const {
    if (kind_ == Kind::password || kind_ == Kind::none) return "Welcome to Nortek " + product_ + "\r\n";
    return "\r\nNortek " + product_ + " Command Interface" + (kind_ == Kind::telnet ? "\r\r\n" : "\r\n");
}

std::string Login::greeting() const {
    if (kind_ == Kind::none) return welcome();
    return kind_ == Kind::password ? ask_password : ask_user;
}

std::string Login::answer(std::string_view line) {
    const bool fits = password_.empty() || line == password_;
    if (kind_ == Kind::password) {
        in_ = fits;
        return in_ ? welcome() : "Wrong password\r\n" + ask_password;
    }
    if (!has_user_) {
        has_user_ = true;
        user_ = line;
        return "Password: ";
    }
    has_user_ = false;
    in_ = fits && user_ == "nortek";
    return in_ ? welcome() : "\r\nLogin failed\r\n" + ask_user;
}

}  // namespace echoloop::nortek_console
