// echoloop fault: asks a running emulator for a fault, by its control socket, and shows what it answers.
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "emulator/contract/error.h"
#include "emulator/scenario/control_place.h"
#include "emulator/scenario/number.h"
#include "emulator/scenario/value.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/fault_answer.h"
#include "tools/echoloop/json_line.h"

namespace echoloop::cli {
namespace {

using Json = nlohmann::ordered_json;

/// "1e-4" is a number, "true" a truth, everything else text.
Json value_of(const std::string& text) {
    if (const auto whole = scenario::parse_as<std::int64_t>(text)) return *whole;
    if (const auto number = scenario::parse_as<double>(text)) return *number;
    if (text == "true" || text == "false") return text == "true";
    return text;
}

Json fault_request(const std::vector<std::string>& words) {
    if (words.size() < 2)
        throw StartError(Exit::usage,
                         "which kind of fault? as in: echoloop fault SOCKET micron bit_flips rate=1e-4; "
                         "`echoloop list --faults` shows the kinds");
    Json fault{{"device", words[0]}, {"kind", words[1]}};
    for (std::size_t i = 2; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        if (equals == 0 || equals == std::string::npos)
            throw StartError(Exit::usage,
                             "expected KEY=VALUE, as in rate=1e-4, got " + scenario::in_quotes(words[i]));
        fault[words[i].substr(0, equals)] = value_of(words[i].substr(equals + 1));
    }
    return {{"fault", fault}};
}

Json request_of(const std::vector<std::string>& words) {
    if (words.empty() || (words[0] == "list" && words.size() == 1)) return {{"list", true}};
    if (words[0] == "status" && words.size() == 1) return {{"status", true}};
    if (words[0] != "clear") return fault_request(words);
    if (words.size() != 2) throw StartError(Exit::usage, "clear what? the number of a fault, or all");
    return {{"clear", value_of(words[1])}};
}

int connect_to(const ControlPlace& place) {
    if (place.path.empty()) {
        const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(place.address.port);
        address.sin_addr.s_addr = htonl(place.address.ip);
        return ::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 ? fd : -1;
    }
    const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, place.path.c_str(), place.path.size() + 1);
    return ::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 ? fd : -1;
}

/// Reads no further than the end of the line. "" if the run has gone, or says nothing for `patience`.
std::string ask(int fd, const Json& request) {
    constexpr std::size_t longest = std::size_t{64} << 20;
    constexpr std::chrono::seconds patience(10);  // a run answers in milliseconds
    const std::string line = line_of(request) + "\n";
    if (::send(fd, line.data(), line.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(line.size())) return {};
    const auto end = std::chrono::steady_clock::now() + patience;
    std::string answer;
    for (char buffer[4096]; answer.size() < longest;) {
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
        pollfd ready{fd, POLLIN, 0};
        if (left.count() <= 0 || ::poll(&ready, 1, static_cast<int>(left.count())) <= 0) return {};
        const ssize_t n = ::read(fd, buffer, sizeof buffer);
        if (n <= 0) return {};
        const std::string_view part(buffer, static_cast<std::size_t>(n));
        answer += part.substr(0, part.find('\n'));
        if (part.find('\n') != part.npos) return answer;
    }
    return {};
}

ControlPlace place_from(const Arguments& arguments) {
    const std::string text = arguments.text("SOCKET");
    try {
        return parse_control_place(text.starts_with('/') ? "unix:" + text : text);
    } catch (const std::invalid_argument& error) {
        throw StartError(Exit::usage, "SOCKET: " + std::string(error.what()));
    }
}

/// A place by TCP asks for it first.
std::string token_for(const ControlPlace& place, const Arguments& arguments) {
    if (!place.path.empty()) return {};
    const char* const kept = std::getenv("ECHOLOOP_TOKEN");
    const std::string token = arguments.has("--token") ? arguments.text("--token") : kept ? kept : "";
    if (token.empty())
        throw StartError(
            Exit::usage,
            "SOCKET: a place by TCP asks for the token that the run printed at its start; give it as "
            "--token TOKEN or in the environment as ECHOLOOP_TOKEN");
    return token;
}

int run_fault(const Arguments& arguments) {
    const Json request = request_of(arguments.all("WORDS"));
    const ControlPlace place = place_from(arguments);
    const std::string token = token_for(place, arguments);
    const int fd = connect_to(place);
    if (fd < 0)
        throw StartError(Exit::unavailable, arguments.text("SOCKET") +
                                                ": cannot be reached: " + std::strerror(errno) +
                                                "; is echoloop run --control with this place running?");
    std::string line = token.empty() ? "" : ask(fd, {{"token", token}});
    if (token.empty() || is_welcome(line)) line = ask(fd, request);
    ::close(fd);
    if (arguments.has("--json") && is_answer(line)) std::printf("%s\n", line.c_str());
    const std::string text = text_of_answer(line);
    if (!arguments.has("--json")) std::printf("%s", text.c_str());
    return 0;
}

}  // namespace

Verb fault_verb() {
    return {
        "fault",
        "make something go wrong in a running emulator",
        {{Argument::Kind::positional, "SOCKET", "", "the place given to run's --control", {}, true},
         {Argument::Kind::words, "WORDS", "",
          "DEVICE KIND [KEY=VALUE]..., or list, status, clear NUMBER, clear all"},
         {Argument::Kind::value, "--token", "TOKEN",
          "what the run printed at its start, for a SOCKET by TCP; or in the environment as ECHOLOOP_TOKEN"},
         json_argument()},
        "  echoloop fault unix:/tmp/echoloop/control micron bit_flips rate=1e-4 for=2\n"
        "  echoloop fault unix:/tmp/echoloop/control micron unplug for=3\n"
        "  echoloop fault unix:/tmp/echoloop/control list\n"
        "  echoloop fault unix:/tmp/echoloop/control clear all\n"
        "  echoloop list --faults                     the kinds, with their parameters",
        run_fault};
}

}  // namespace echoloop::cli
