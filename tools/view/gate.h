// Who may look at the page, and what is answered to a plain request. Opens nothing.
#pragma once

#include <boost/beast/http.hpp>
#include <string>
#include <string_view>

#include "emulator/contract/device.h"

namespace echoloop::view {

using Request = boost::beast::http::request<boost::beast::http::empty_body>;
using Answer = boost::beast::http::response<boost::beast::http::string_body>;

/// A page must not be shown in another's frame, load anything from elsewhere or be read by another page.
template <class Body>
void secure(boost::beast::http::response<Body>& answer) {
    namespace http = boost::beast::http;
    answer.set(http::field::server, "echoloop");
    answer.set(http::field::cache_control, "no-store");
    answer.set("Content-Security-Policy",
               "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' "
               "data: blob:; "
               "base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    answer.set("X-Content-Type-Options", "nosniff");
    answer.set("Referrer-Policy", "no-referrer");
    answer.set("Cross-Origin-Resource-Policy", "same-origin");
}

class Gate {
  public:
    static constexpr std::string_view protocol = "echoloop.view";  ///< of the page's WebSocket

    /// `place`: where the port is open; `token`: who has it may look.
    Gate(Address place, std::string token) : place_(place), token_(std::move(token)) {}

    std::string link() const;
    /// A page of another site makes a browser ask with that site's name, or with its own for this machine.
    bool is_for_us(const Request& request) const;
    static bool is_from_here(const Request& request);
    /// Of a WebSocket that says "echoloop.view, TOKEN" as its protocols: a browser can say it nowhere else.
    bool lets_in(const Request& request) const;
    /// Of a plain request: the page, its scene, or why not.
    Answer answer_to(const Request& request, const std::string& scene) const;

  private:
    Address place_;
    std::string token_;
};

}  // namespace echoloop::view
