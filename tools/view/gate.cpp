#include "tools/view/gate.h"

#include "emulator/transport/address.h"
#include "tools/view/page.h"

namespace echoloop::view {
namespace {

namespace http = boost::beast::http;

std::string text_of(boost::beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

std::string Gate::link() const { return "http://" + to_text(place_) + "/#" + token_; }

bool Gate::is_for_us(const Request& request) const {
    const auto host = request[http::field::host];
    const std::string port = ":" + std::to_string(place_.port);
    return host == to_text(place_) || (is_loopback(place_.ip) && host == "localhost" + port);
}

bool Gate::is_from_here(const Request& request) {
    const auto origin = request[http::field::origin];
    return origin.empty() || origin == "http://" + text_of(request[http::field::host]);
}

bool Gate::lets_in(const Request& request) const {
    return is_for_us(request) && is_from_here(request) &&
           text_of(request[http::field::sec_websocket_protocol]) == std::string(protocol) + ", " + token_;
}

Answer Gate::answer_to(const Request& request, const std::string& scene) const {
    Answer answer{http::status::ok, request.version()};
    secure(answer);
    const auto refuse = [&](http::status status, std::string_view reason) {
        answer.result(status);
        answer.set(http::field::content_type, "text/plain; charset=utf-8");
        answer.body() = std::string(reason) + "\n";
    };
    constexpr std::string_view no_token = "open the link that the run printed; its end is a token";
    if (!is_for_us(request)) {
        refuse(http::status::misdirected_request,
               "Host: this page is at " + link().substr(0, link().find('#')));
    } else if (!is_from_here(request)) {
        refuse(http::status::forbidden, "Origin: another page may not ask");
    } else if (request.method() != http::verb::get) {
        refuse(http::status::method_not_allowed, "only GET is answered");
    } else if (const PagePart* part = find_page_part(text_of(request.target()))) {
        answer.set(http::field::content_type, std::string(part->type));
        answer.body() = part->text;
    } else if (request.target() == "/scene") {
        if (request[http::field::authorization] != "Bearer " + token_) {
            refuse(http::status::unauthorized, no_token);
        } else {
            answer.set(http::field::content_type, "application/octet-stream");
            answer.body() = scene;
        }
    } else if (request.target() == "/news") {
        refuse(http::status::unauthorized, no_token);
    } else {
        refuse(http::status::not_found, "there is only the page itself");
    }
    return answer;
}

}  // namespace echoloop::view
