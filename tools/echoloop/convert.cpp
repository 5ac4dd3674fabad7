// echoloop convert: the shots of an Imagenex head out of a capture into the maker's file, .852 or .81A. Reads
// and writes piece by piece; speaks to no device.
#include <sys/stat.h>

#include <cctype>
#include <fstream>
#include <map>
#include <optional>

#include "emulator/contract/error.h"
#include "emulator/scenario/problems.h"
#include "emulator/scenario/value.h"
#include "protocols/imagenex/framer.h"
#include "protocols/imagenex/shot_writer.h"
#include "tools/capture/open.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/output_file.h"
#include "tools/echoloop/terminal.h"
#include "tools/echoloop/verb.h"

namespace echoloop::cli {
namespace {

using capture::Input;
using capture::StreamPiece;
using imagenex::ShotFormat;

ShotFormat format_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    for (char& c : ending) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (ending == ".852") return ShotFormat::shot_852;
    if (ending == ".81A") return ShotFormat::shot_81a;
    throw StartError(Exit::usage, "OUT: " + scenario::in_quotes(file.string()) +
                                      " names no known kind of file; end it in .852 or .81A");
}

/// What both ends of one line say, as shots of a file.
class Line {
  public:
    Line(ShotFormat format, std::ostream& out) : writer_(format), out_(out) {}

    void add(bool direction, double time, ByteView bytes, bool gap) {
        imagenex::Framer& framer = framers_[direction ? 1 : 0];
        if (gap) framer.clear();
        framer.feed(bytes);
        while (const auto frame = framer.next()) take(*frame, time);
    }
    std::size_t shots() const { return shots_; }

  private:
    void take(const wire::Bytes& frame, double time) {
        const auto message = imagenex::parse(frame);
        if (!message) return;
        if (const auto* command = std::get_if<imagenex::SwitchCommand>(&*message)) writer_.command(*command);
        const auto* reply = std::get_if<imagenex::Reply>(&*message);
        if (reply == nullptr) return;
        const auto shot = writer_.shot(*reply, time);
        out_.write(reinterpret_cast<const char*>(shot.data()), static_cast<std::streamsize>(shot.size()));
        ++shots_;
    }

    imagenex::ShotWriter writer_;
    std::ostream& out_;
    imagenex::Framer framers_[2];
    std::size_t shots_ = 0;
};

/// Name of a line: its interface, or its TCP connection whichever way the bytes go.
std::string name_of_line(const StreamPiece& piece) {
    if (piece.from.port == 0) return piece.line;
    return text_of(std::min(piece.from, piece.to)) + " - " + text_of(std::max(piece.from, piece.to));
}

std::size_t convert_capture(capture::CaptureReader& capture, const std::string& wanted, Line& line) {
    std::map<std::string, bool> names;
    while (const auto event = capture.next()) {
        const auto* piece = std::get_if<StreamPiece>(&event->content);
        if (piece == nullptr) continue;
        const std::string name = name_of_line(*piece);
        names[name] = true;
        if (!wanted.empty() && name != wanted) continue;
        const bool way = piece->from.port == 0 ? piece->sent : piece->from < piece->to;
        line.add(way, event->time, piece->bytes, piece->gap);
    }
    const auto counts = capture.counts();
    for (const auto& trouble : capture::troubles(counts)) print_warning(trouble);
    std::string all;
    for (const auto& [name, unused] : names) all += (all.empty() ? "" : ", ") + scenario::in_quotes(name);
    if (wanted.empty() && names.size() > 1)
        throw StartError(Exit::usage, "the capture holds several lines; choose one with --line: " + all);
    if (!wanted.empty() && !names.contains(wanted))
        throw StartError(Exit::usage, "--line: no line " + scenario::in_quotes(wanted) +
                                          " in the capture; it holds " + (all.empty() ? "none" : all));
    return line.shots();
}

/// A plain file of bytes knows no times but its own.
std::size_t convert_bytes(Input& input, Line& line) {
    struct stat status {};
    const bool is_file = ::stat(input.name().c_str(), &status) == 0;
    const auto time = static_cast<double>(is_file ? status.st_mtime : 0);
    for (Bytes bytes; !(bytes = input.read(std::size_t{64} << 10)).empty();)
        line.add(false, time, bytes, false);
    return line.shots();
}

std::size_t convert(Input& input, const std::string& line, ShotFormat format,
                    const std::filesystem::path& file) {
    std::ofstream out(file, std::ios::binary);
    Line shots(format, out);
    const auto log = capture::open_if_log(input);
    const auto count = log ? convert_capture(*log, line, shots) : convert_bytes(input, shots);
    if (count == 0)
        throw StartError(Exit::data, scenario::in_quotes(input.name()) + ": no reply of an Imagenex head");
    if (!out.flush()) throw std::runtime_error("cannot write all of it");
    return count;
}

int run_convert(const Arguments& arguments) {
    const std::filesystem::path out = arguments.text("OUT");
    const ShotFormat format = format_of(out);
    require_creatable(out);
    Input input(arguments.text("CAPTURE"));
    std::size_t shots = 0;
    std::optional<StartError> refused;  // its reason and status; write_whole knows those of files only
    try {
        write_whole(out, [&](const std::filesystem::path& file) {
            try {
                shots = convert(input, arguments.text("--line"), format, file);
            } catch (const StartError& error) {
                refused = error;
                throw;
            }
        });
    } catch (const StartError&) {
        if (refused) throw *refused;
        throw;
    }
    std::printf("%s\n", counted(shots, "shot").c_str());
    return 0;
}

}  // namespace

Verb convert_verb() {
    using Kind = Argument::Kind;
    return {
        "convert",
        "convert a capture to the sonar maker's own file format",
        {{Kind::positional,
          "CAPTURE",
          "",
          "pcap or pcapng with serial lines or TCP, a serial log as text, or raw bytes of both directions",
          {},
          true},
         {Kind::positional, "OUT", "", "file to write: .852 or .81A (Imagenex)", {}, true},
         {Kind::value, "--line", "NAME", "the line to convert, if the capture holds several"}},
        "  echoloop run config/imagenex-852.yaml --record dive.pcapng\n"
        "  echoloop convert dive.pcapng dive.852",
        run_convert};
}

}  // namespace echoloop::cli
