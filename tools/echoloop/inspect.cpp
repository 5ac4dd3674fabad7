// echoloop inspect: the messages in a capture or in a file of bytes. Reads to the end in bounded memory.
#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "emulator/scenario/problems.h"
#include "protocols/inspect.h"
#include "protocols/stream_decoder.h"
#include "tools/capture/capture.h"
#include "tools/capture/stream_windows.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/json_output.h"
#include "tools/echoloop/terminal.h"

namespace echoloop::cli {
namespace {

using capture::Datagram;
using capture::Input;
using capture::StreamPiece;
using inspect::StreamDecoder;

constexpr std::size_t largest_datagram = 65535;

/// Where a message comes from, as people and as JSON see it.
std::string origin_text(const InspectOrigin& origin) {
    if (!origin.from && origin.line.empty()) return {};
    const auto who = origin.from ? text_of(*origin.from) + " -> " + text_of(*origin.to) : origin.line;
    return "  t=" + plain(origin.time, 6) + " s  " + who;
}

/// "16 (ReBoot)", "31.948 m", "29176 x 0.01 K". Bytes of the capture that would steer a terminal are
/// replaced.
std::string field_text(const inspect::Field& field) {
    std::string text = field.text;
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == 127) c = '.';
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

    InspectSummary& summary() { return summary_; }

    void finish() const {
        if (json_) {
            std::printf("\n],\n\"summary\": %s}\n", summary_json(summary_).c_str());
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
        std::printf("\n");
    }

  private:
    bool json_, quiet_;
    bool first_ = true;
    InspectSummary summary_;
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
std::string line_text(const StreamPiece& piece) {
    return (piece.line.empty() ? "serial line" : piece.line) + (piece.sent ? ", sent" : ", received");
}

/// The streams of a capture, or its datagrams as such, each direction decoded by itself.
class Streams {
  public:
    Streams(const inspect::Family* family, Output& output) : family_(family), output_(output) {}

    void add(double time, const StreamPiece& piece) {
        const auto line = piece.from.port == 0 ? line_text(piece) : std::string();
        const Key key{line, piece.from, piece.to};
        if (piece.gap) end(key);
        continue_with(key, time, piece.bytes);
    }
    /// A datagram is read alone where that tells all of it, as nearly always. What is left of others goes on
    /// in the next one of the same direction.
    void add(double time, const Datagram& datagram) {
        const Key key{"", datagram.from, datagram.to};
        const auto* family = family_ != nullptr ? family_ : inspect::guess_family(datagram.payload);
        if (datagram.cut) {
            end(key);
            const char* reason = family == nullptr ? "no known protocol" : "cut short by the capture";
            return printer(key, time)(family, undecoded(datagram.payload.size(), reason));
        }
        const bool alone = family != nullptr && family->framing == inspect::Framing::datagram;
        const auto messages = family == nullptr ? Messages{} : family->decode(datagram.payload);
        if (!alone && !is_whole(messages)) return continue_with(key, time, datagram.payload);
        if (!alone) end(key);
        for (const auto& message : messages) printer(key, time)(family, message);
    }
    void finish() {
        for (auto& [key, stream] : streams_) stream.decoder.finish(printer(key, stream.time));
        streams_.clear();
    }

  private:
    using Key = std::tuple<std::string, Address, Address>;
    using Messages = std::vector<inspect::Message>;
    struct Stream {
        StreamDecoder decoder;
        double time = 0;  ///< of the last bytes
    };

    static bool is_whole(const Messages& messages) {
        return !messages.empty() &&
               std::none_of(messages.begin(), messages.end(), [](const auto& m) { return m.name.empty(); });
    }

    void continue_with(const Key& key, double time, ByteView bytes) {
        constexpr std::size_t most = 4096;
        if (!streams_.contains(key) && streams_.size() >= most) finish();
        Stream& stream = streams_.try_emplace(key, Stream{StreamDecoder(family_), time}).first->second;
        stream.time = time;
        stream.decoder.add(bytes, printer(key, time));
    }
    /// What did not become complete never will.
    void end(const Key& key) {
        const auto found = streams_.find(key);
        if (found != streams_.end()) found->second.decoder.finish(printer(key, found->second.time));
    }

    StreamDecoder::Each printer(const Key& key, double time) {
        const auto& [line, from, to] = key;
        InspectOrigin origin{"", time, {}, {}, line};
        if (line.empty()) {
            origin.from = from;
            origin.to = to;
        }
        return [this, origin](const inspect::Family* family, const inspect::Message& message) mutable {
            origin.family = family == nullptr ? "" : std::string(family->name);
            output_.add(origin, message);
        };
    }

    const inspect::Family* family_;
    Output& output_;
    std::map<Key, Stream> streams_;
};

void inspect_capture(Input& input, const inspect::Family* family, Output& output) {
    std::optional<double> start;
    Streams streams(family, output), datagrams(family, output);
    const auto since_start = [&start](double time) {
        if (!start) start = time;
        return time - *start;
    };
    const auto counts = capture::read_capture(
        input,
        {.datagram = [&](double time,
                         const Datagram& datagram) { datagrams.add(since_start(time), datagram); },
         .stream = [&](double time, const StreamPiece& piece) { streams.add(since_start(time), piece); }});
    streams.finish();
    datagrams.finish();
    output.summary().packets = counts.packets;
    output.summary().skipped_packets = counts.skipped;
    output.summary().incomplete = counts.incomplete;
    if (!counts.fault.empty()) print_warning("the capture ends early: " + counts.fault);
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

int run(const Arguments& arguments) {
    if (const auto* family = forced_family(arguments, "--tables")) {
        std::printf("%s", inspect::markdown_tables(*family).c_str());
        return 0;
    }
    const auto* family = forced_family(arguments, "--family");
    if (!arguments.has("CAPTURE"))
        throw StartError(Exit::usage, "CAPTURE is missing: name a file, or '-' for standard input");
    Input input(arguments.text("CAPTURE"));
    Output output(arguments);
    input.is_capture() ? inspect_capture(input, family, output) : inspect_bytes(input, family, output);
    output.finish();
    if (!output.summary().messages.empty()) return 0;
    throw StartError(Exit::data, scenario::in_quotes(arguments.text("CAPTURE")) +
                                     ": no message of a known protocol; --family names the protocol to try");
}

}  // namespace

Verb inspect_verb() {
    using Kind = Argument::Kind;
    return {
        "inspect",
        "print the messages in a capture or in a file of bytes",
        {{Kind::optional, "CAPTURE", "", "pcap, pcapng, or raw bytes of a serial line; '-': standard input"},
         {Kind::value, "--family", "NAME", "protocol family; without it: guessed (r2sonic, seanet)"},
         {Kind::value, "--tables", "NAME", "print the message tables of a family as Markdown instead"},
         {Kind::flag, "--summary", "", "print the summary only"},
         json_argument()},
        "  echoloop inspect dive.pcapng\n"
        "  echoloop inspect line.bin --family seanet --json\n"
        "  tcpdump -w - udp | echoloop inspect -\n"
        "  echoloop inspect --tables seanet > messages.md",
        run};
}

}  // namespace echoloop::cli
