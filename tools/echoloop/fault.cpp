// echoloop fault: asks a running emulator for a fault, by its control socket, and shows what it answers.
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "emulator/contract/error.h"
#include "emulator/scenario/control_place.h"
#include "emulator/scenario/number.h"
#include "emulator/scenario/value.h"
#include "tools/echoloop/common.h"
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

/// Reads no further than the end of the line. "" if the run has gone.
std::string ask(int fd, const Json& request) {
    constexpr std::size_t longest = std::size_t{64} << 20;
    const std::string line = line_of(request) + "\n";
    if (::send(fd, line.data(), line.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(line.size())) return {};
    std::string answer;
    for (char buffer[4096]; answer.size() < longest;) {
        const ssize_t n = ::read(fd, buffer, sizeof buffer);
        if (n <= 0) return {};
        const std::string_view part(buffer, static_cast<std::size_t>(n));
        answer += part.substr(0, part.find('\n'));
        if (part.find('\n') != part.npos) return answer;
    }
    return {};
}

void print_fault(const Json& fault) {
    std::printf("%4d  ", fault.value("id", 0));
    for (const auto& [key, value] : fault.items())
        if (key != "id")
            std::printf("%s%s ", key == "device" || key == "kind" ? "" : (key + "=").c_str(),
                        value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
    std::printf("\n");
}

void print_device(const Json& device) {
    std::printf("%s", padded(device.value("name", ""), 16).c_str());
    for (const auto& [key, value] : device.items())
        if (key != "name" && key != "faults") std::printf("%s %s  ", value.dump().c_str(), key.c_str());
    std::printf("\n");
    for (const auto& [kind, made] : device.at("faults").items())
        std::printf("%s%s %s\n", padded("", 16).c_str(), made.dump().c_str(), kind.c_str());
}

void print_answer(const Json& answer) {
    if (answer.contains("id"))
        std::printf("fault %d; `clear %d` ends it\n", answer.value("id", 0), answer.value("id", 0));
    if (answer.contains("cleared"))
        std::printf("%s cleared\n", counted(answer.value("cleared", std::uint64_t{0}), "fault").c_str());
    if (answer.contains("faults") && answer.at("faults").empty()) std::printf("no faults\n");
    if (answer.contains("faults"))
        for (const Json& fault : answer.at("faults")) print_fault(fault);
    if (answer.contains("devices"))
        for (const Json& device : answer.at("devices")) print_device(device);
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

bool is_welcome(const Json& answer) {
    const auto ok = answer.is_object() ? answer.find("ok") : answer.end();
    return ok != answer.end() && *ok == true;
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
    Json answer = Json::parse(line, nullptr, false);
    if (token.empty() || is_welcome(answer)) {
        line = ask(fd, request);
        answer = Json::parse(line, nullptr, false);
    }
    ::close(fd);
    if (!answer.is_object()) throw StartError(Exit::io, "the run ended without an answer");
    if (arguments.has("--json")) std::printf("%s\n", line.c_str());
    try {
        if (!answer.value("ok", false)) throw StartError(Exit::data, answer.value("error", "refused"));
        if (!arguments.has("--json")) print_answer(answer);
    } catch (const Json::exception&) {
        throw StartError(Exit::io,
                         "the answer is not from a run; is SOCKET the place given to its --control?");
    }
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
