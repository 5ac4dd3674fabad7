// echoloop inspect: the messages in a capture or in a file of bytes. Reads to the end in bounded memory.
#include <algorithm>
#include <cstdio>
#include <optional>

#include "emulator/scenario/problems.h"
#include "protocols/inspect.h"
#include "tools/capture/messages.h"
#include "tools/capture/open.h"
#include "tools/capture/stream_windows.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/json_inspect.h"
#include "tools/echoloop/terminal.h"

namespace echoloop::cli {
namespace {

using capture::Input;

constexpr std::size_t largest_datagram = 65535;

/// Bytes of the capture that would steer a terminal are replaced.
std::string harmless(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == 127) c = '.';
    return text;
}

/// Where a message comes from, as people see it.
std::string origin_text(const InspectOrigin& origin) {
    if (!origin.from && origin.line.empty()) return {};
    const auto who =
        origin.from ? text_of(*origin.from) + " -> " + text_of(*origin.to) : harmless(origin.line);
    return "  t=" + plain(origin.time, 6) + " s  " + who;
}

/// "16 (ReBoot)", "31.948 m", "29176 x 0.01 K".
std::string field_text(const inspect::Field& field) {
    const std::string text = harmless(field.text);
    if (field.unit.empty()) return text;
    const bool factor = field.unit.front() >= '0' && field.unit.front() <= '9';
    return text + (factor ? " x " : " ") + field.unit;
}

void print_message(const InspectOrigin& origin, const inspect::Message& message) {
    const auto from = origin_text(origin);
    if (message.name.empty()) {
        std::printf("@%zu  %zu bytes not decoded: %s%s\n\n", message.offset, message.size,
                    message.reason.c_str(), from.c_str());
        return;
    }
    std::printf("@%zu  %s %s, %zu bytes%s\n", message.offset, origin.family.c_str(), message.name.c_str(),
                message.size, from.c_str());
    for (const auto& field : message.fields)
        std::printf("  %s%s%s\n", padded(std::to_string(field.offset), 6).c_str(),
                    padded(field.name, 28).c_str(), field_text(field).c_str());
    if (!message.reason.empty()) std::printf("  incomplete: %s\n", message.reason.c_str());
    std::printf("\n");
}

/// Prints messages as they come and counts them.
class Output {
  public:
    explicit Output(const Arguments& arguments)
        : json_(arguments.has("--json")), quiet_(arguments.has("--summary")) {
        if (json_) std::printf("{\"messages\": [");
    }

    void add(const InspectOrigin& origin, const inspect::Message& message) {
        if (message.name.empty()) summary_.undecoded_bytes += message.size;
        if (!message.name.empty() && message.reason.empty()) ++summary_.messages[message.name];
        if (!message.name.empty() && !message.reason.empty()) ++summary_.broken;
        if (quiet_) return;
        if (json_) {
            std::printf("%s\n%s", first_ ? "" : ",", message_json(origin, message).c_str());
            first_ = false;
        } else {
            print_message(origin, message);
        }
    }

    /// Of the last packets beyond a sane number none is kept.
    void add(PacketComment comment) {
        constexpr std::size_t most = 100000;
        ++summary_.comments;
        if (json_ && comments_.size() < most) comments_.push_back(std::move(comment));
        if (json_ || quiet_) return;
        std::printf("comment on packet %llu  t=%s s: %s\n\n", static_cast<unsigned long long>(comment.packet),
                    plain(comment.time, 6).c_str(), scenario::printable(comment.text).c_str());
    }

    InspectSummary& summary() { return summary_; }

    void finish() const {
        if (json_) {
            std::printf("\n],\n\"comments\": %s,\n\"summary\": %s}\n", comments_json(comments_).c_str(),
                        summary_json(summary_).c_str());
            return;
        }
        std::string names;
        for (const auto& [name, count] : summary_.messages)
            names += (names.empty() ? "" : ", ") + name + " " + std::to_string(count);
        std::printf("messages: %s; broken %zu; not decoded %zu bytes", names.empty() ? "none" : names.c_str(),
                    summary_.broken, summary_.undecoded_bytes);
        if (summary_.packets)
            std::printf("; packets %llu, not understood %llu, missing fragments %zu",
                        static_cast<unsigned long long>(*summary_.packets),
                        static_cast<unsigned long long>(summary_.skipped_packets), summary_.incomplete);
        if (summary_.comments > 0) std::printf("; comments %zu", summary_.comments);
        std::printf("\n");
    }

  private:
    bool json_, quiet_;
    bool first_ = true;
    InspectSummary summary_;
    std::vector<PacketComment> comments_;
};

const inspect::Family* forced_family(const Arguments& arguments, const char* name) {
    if (!arguments.has(name)) return nullptr;
    std::vector<std::string_view> known;
    for (const auto& family : inspect::families()) known.push_back(family.name);
    const auto wanted = arguments.text(name);
    if (const auto* family = inspect::find_family(wanted)) return family;
    throw StartError(Exit::usage, std::string(name) + ": unknown family " + scenario::in_quotes(wanted) +
                                      scenario::suggestion(wanted, known));
}

inspect::Message undecoded(std::size_t size, const char* reason) {
    return {.offset = 0, .size = size, .reason = reason};
}

/// Names of the two who speak on a captured serial line.
std::string line_text(const capture::Way& way) {
    return (way.line.empty() ? "serial line" : way.line) + (way.sent ? ", sent" : ", received");
}

InspectOrigin origin_of(const capture::MessageOrigin& from, double start) {
    InspectOrigin origin{from.family == nullptr ? "" : std::string(from.family->name), from.time - start};
    origin.packet = from.packet;
    if (from.way.is_serial()) {
        origin.line = line_text(from.way);
    } else {
        origin.from = from.way.from;
        origin.to = from.way.to;
    }
    return origin;
}

void inspect_capture(Input& input, capture::CaptureReader& file, const inspect::Family* family,
                     Output& output) {
    std::optional<double> start;
    capture::MessageSorter messages(
        family, [&](const auto& from, const auto& message) { output.add(origin_of(from, *start), message); });
    while (const auto event = file.next()) {
        if (!start) start = event->time;
        messages.add(*event);
        if (!event->comment.empty()) output.add({event->packet, event->time - *start, event->comment});
    }
    messages.finish();
    const auto counts = file.counts();
    if (counts.packets == 0 && !counts.fault.empty())
        throw StartError(Exit::data, scenario::in_quotes(input.name()) +
                                         " is no capture that can be read: " + counts.fault);
    output.summary().packets = counts.packets;
    output.summary().skipped_packets = counts.skipped;
    output.summary().incomplete = counts.incomplete;
    for (const auto& trouble : capture::troubles(counts)) print_warning(trouble);
}

/// A file that holds one datagram and nothing else.
void inspect_one_datagram(Input& input, const inspect::Family& family, Output& output) {
    const auto bytes = input.read(largest_datagram + 1);
    if (bytes.size() > largest_datagram)
        throw StartError(Exit::data, scenario::in_quotes(input.name()) + " is larger than a datagram of " +
                                         std::string(family.name) + "; give a pcap or pcapng capture");
    for (const auto& message : family.decode(bytes)) output.add({std::string(family.name)}, message);
}

void inspect_bytes(Input& input, const inspect::Family* family, Output& output) {
    const auto start = input.peek(std::size_t{64} << 10);
    if (family == nullptr) family = inspect::guess_family(start);
    if (family == nullptr) {
        std::size_t size = 0;
        for (Bytes bytes; !(bytes = input.read(std::size_t{1} << 20)).empty();) size += bytes.size();
        output.add({}, undecoded(size, "no known protocol"));
    } else if (family->framing == inspect::Framing::datagram) {
        inspect_one_datagram(input, *family, output);
    } else {
        capture::decode_windows(input, *family,
                                [&](const auto& m) { output.add({std::string(family->name)}, m); });
    }
}

int run_inspect(const Arguments& arguments) {
    if (const auto* family = forced_family(arguments, "--tables")) {
        std::printf("%s", inspect::markdown_tables(*family).c_str());
        return 0;
    }
    const auto* family = forced_family(arguments, "--family");
    if (!arguments.has("CAPTURE"))
        throw StartError(Exit::usage, "CAPTURE is missing: name a file, or '-' for standard input");
    Input input(arguments.text("CAPTURE"));
    Output output(arguments);
    if (const auto log = capture::open_if_log(input)) {
        inspect_capture(input, *log, family, output);
    } else {
        inspect_bytes(input, family, output);
        if (!input.fault().empty()) print_warning("the file ends early: " + input.fault());
    }
    output.finish();
    if (!output.summary().messages.empty()) return 0;
    throw StartError(Exit::data, scenario::in_quotes(arguments.text("CAPTURE")) +
                                     ": no message of a known protocol; --family names the protocol to try");
}

}  // namespace

Verb inspect_verb() {
    using Kind = Argument::Kind;
    return {"inspect",
            "print the messages in a capture or in a file of bytes",
            {{Kind::optional, "CAPTURE", "",
              "pcap, pcapng, a maker's recording, a serial log as text, or raw bytes; '-': standard input"},
             {Kind::value, "--family", "NAME", "protocol family, e.g. seanet; default: guessed"},
             {Kind::value, "--tables", "NAME", "print the message tables of a family as Markdown instead"},
             {Kind::flag, "--summary", "", "print the summary only"},
             json_argument()},
            "  echoloop inspect dive.pcapng\n"
            "  echoloop inspect line.bin --family seanet --json\n"
            "  tcpdump -w - udp | echoloop inspect -\n"
            "  echoloop inspect --tables seanet > messages.md",
            run_inspect};
}

}  // namespace echoloop::cli
