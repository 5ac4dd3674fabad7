// How a host logs in to a Nortek instrument by TCP: by a password alone, or by a user's name and a password.
// A small state machine of lines; knows no port.
#pragma once

#include <string>
#include <string_view>

namespace echoloop::nortek_console {

class Login {
  public:
    /// telnet: as user, with a line end of telnet behind the welcome.
    enum class Kind { user, telnet, password, none };

    /// Nobody has to log in.
    Login() = default;
    /// `password`: empty: any will do. `product`: whom it welcomes to.
    Login(Kind kind, std::string password, std::string product)
        : kind_(kind),
          in_(kind == Kind::none),
          password_(std::move(password)),
          product_(std::move(product)) {}

    bool in() const { return in_; }
    /// What it says to a host that has just come.
    std::string greeting() const;
    /// What it says to a line of the host, without its end.
    std::string answer(std::string_view line);

  private:
    std::string welcome() const;

    Kind kind_ = Kind::none;
    bool in_ = true, has_user_ = false;
    std::string password_, product_, user_;
};

}  // namespace echoloop::nortek_console
