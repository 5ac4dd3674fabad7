#include "tools/echoloop/replay_ports.h"

#include <algorithm>
#include <stdexcept>

#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"
#include "tools/echoloop/common.h"

namespace echoloop::cli {
namespace {

using capture::PortFilter;
using capture::PortKind;
using capture::PortSummary;
using capture::SideCounts;
using capture::Survey;

std::string side_text(const SideCounts& side) {
    return counted(side.pieces, "piece") + " of " + counted(side.bytes, "byte");
}

[[noreturn]] void refuse(const std::string& what, const Survey& survey) {
    throw StartError(Exit::usage, what + ". The capture holds:\n" + ports_text(survey));
}

Endpoint endpoint_from(const std::string& uri) {
    try {
        return parse_endpoint(uri);
    } catch (const std::invalid_argument& error) {
        throw StartError(Exit::usage, error.what());
    }
}

/// Both parts of PORT=ENDPOINT; either may hold a '=' of its own.
std::pair<std::string, std::string> split(const std::string& text) {
    std::size_t at = std::string::npos;
    for (const char* scheme : {"=pty:", "=serial:", "=tcp-listen:", "=tcp:", "=udp-listen:", "=udp:"})
        at = std::min(at, text.find(scheme));
    if (at == std::string::npos)
        throw StartError(Exit::usage,
                         "--play: " + scenario::in_quotes(text) +
                             " is not of the form PORT=ENDPOINT, e.g. \"micron line=pty:/tmp/micron\"");
    return {text.substr(0, at), text.substr(at + 1)};
}

class Chooser {
  public:
    Chooser(const Survey& survey, bool driver_side) : survey_(survey), driver_side_(driver_side) {}

    Assignment choose(const std::string& filter, const std::string& uri) const {
        Assignment chosen{.port = {}, .name = filter, .endpoint = endpoint_from(uri)};
        const PortFilter wanted(filter);
        SideCounts end, others;
        for (const PortSummary& port : survey_.ports) {
            if (!wanted.fits(port.key)) continue;
            const bool end_is_first = wanted.end_is_first(port.key).value_or(port.first_is_device());
            add(end, end_is_first ? port.first : port.second);
            add(others, end_is_first ? port.second : port.first);
            chosen.port.keys[port.key] = end_is_first;
            include(chosen, port);
        }
        if (chosen.port.keys.empty())
            refuse("no port " + scenario::in_quotes(filter) + " in the capture", survey_);
        if (const auto& keys = chosen.port.keys; keys.size() > 1 && !keys.begin()->first.name.empty())
            refuse(scenario::in_quotes(filter) + " has several ports; name one of them", survey_);
        const bool certain = std::ranges::any_of(chosen.port.keys, [](const auto& k) {
            return k.first.kind == PortKind::serial || !k.first.name.empty();
        });
        const bool end_is_device = certain || end.bytes >= others.bytes;
        return finish(std::move(chosen), end_is_device ? end : others, end_is_device ? others : end,
                      end_is_device);
    }

    Assignment choose_only(const std::string& uri) const {
        std::vector<const PortSummary*> speaking;
        for (const PortSummary& port : survey_.ports)
            if ((driver_side_ ? port.driver() : port.device()).pieces > 0) speaking.push_back(&port);
        if (speaking.size() > 1) refuse("the capture holds several ports; choose one with --port", survey_);
        if (speaking.empty()) refuse("there is nothing to play", survey_);
        return choose(speaking.front()->text(), uri);
    }

  private:
    static void add(SideCounts& sum, const SideCounts& more) {
        sum.pieces += more.pieces;
        sum.bytes += more.bytes;
    }

    static void include(Assignment& chosen, const PortSummary& port) {
        const bool first = chosen.port.keys.size() == 1;
        chosen.begin = first ? port.begin : std::min(chosen.begin, port.begin);
        chosen.end = first ? port.end : std::max(chosen.end, port.end);
        chosen.datagrams = port.key.kind == PortKind::udp;
        chosen.port.drivers.insert(port.drivers.begin(), port.drivers.end());
    }

    Assignment finish(Assignment chosen, const SideCounts& device, const SideCounts& driver,
                      bool end_is_device) const {
        const SideCounts& played = driver_side_ ? driver : device;
        chosen.pieces = played.pieces;
        chosen.bytes = played.bytes;
        if (end_is_device == driver_side_)
            for (auto& [key, first] : chosen.port.keys) first = !first;
        return chosen;
    }

    const Survey& survey_;
    bool driver_side_;
};

}  // namespace

capture::OpenSettings settings_for_playing(const Arguments& arguments) {
    return {.interval = arguments.number("--interval", 0, 1e-6, 1e6), .as_sent = true};
}

const inspect::Family* family_asked_for(const Arguments& arguments) {
    if (!arguments.has("--family")) return nullptr;
    const auto wanted = arguments.text("--family");
    if (const auto* family = inspect::find_family(wanted)) return family;
    throw StartError(Exit::usage, "--family: unknown family " + scenario::in_quotes(wanted) +
                                      "; echoloop inspect guesses it");
}

std::string ports_text(const Survey& survey) {
    std::string text;
    for (const PortSummary& port : survey.ports)
        text += (text.empty() ? "  " : "\n  ") + padded(scenario::in_quotes(port.text()), 44) + "device " +
                side_text(port.device()) + ", driver " + side_text(port.driver());
    return text.empty() ? "  nothing that can be played" : text;
}

std::vector<Assignment> assignments_from(const Arguments& arguments, const Survey& survey) {
    const Chooser chooser(survey, arguments.text("--direction", "device") == "driver");
    std::vector<Assignment> all;
    for (const auto& pair : arguments.all("--play")) {
        const auto [port, uri] = split(pair);
        all.push_back(chooser.choose(port, uri));
    }
    if (arguments.has("ENDPOINT")) {
        const auto uri = arguments.text("ENDPOINT");
        all.push_back(arguments.has("--port") ? chooser.choose(arguments.text("--port"), uri)
                                              : chooser.choose_only(uri));
    }
    if (all.empty()) refuse("ENDPOINT is missing: name where to play, e.g. pty:/tmp/sonar", survey);
    for (auto one = all.begin(); one != all.end(); ++one)
        for (auto other = all.begin(); other != one; ++other)
            if (clash(one->endpoint, other->endpoint))
                throw StartError(Exit::usage, "two ports cannot be played on " + to_string(one->endpoint));
    return all;
}

}  // namespace echoloop::cli
