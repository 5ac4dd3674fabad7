// echoloop convert: what a device said in a capture as the maker's own kind of file, or any messages as a
// table. Reads and writes piece by piece; speaks to no device.
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
#include "tools/echoloop/convert/bag.h"
#include "tools/echoloop/convert/from_capture.h"
#include "tools/echoloop/output_file.h"
#include "tools/echoloop/terminal.h"
#include "tools/echoloop/verb.h"
#include "tools/echoloop/watched_capture.h"

namespace echoloop::cli {
namespace {

using capture::Input;
using capture::StreamPiece;
using imagenex::ShotFormat;

std::string ending_of(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ending;
}

std::optional<ShotFormat> shot_format_of(const std::filesystem::path& file) {
    if (ending_of(file) == ".852") return ShotFormat::shot_852;
    if (ending_of(file) == ".81a") return ShotFormat::shot_81a;
    if (ending_of(file) == ".31l") return ShotFormat::shot_31l;
    return {};
}

/// What both ends of one line say, as shots of a file.
class Line {
  public:
    Line(ShotFormat format, std::ostream& out)
        : writer_(format), of_831l_(format == ShotFormat::shot_31l), out_(out) {}

    void add(bool direction, double time, ByteView bytes, bool gap) {
        imagenex::Framer& framer = framers_[direction ? 1 : 0];
        if (gap) framer.clear();
        framer.feed(bytes);
        while (const auto frame = framer.next()) take(*frame, time);
    }
    std::size_t shots() const { return shots_; }
    /// Replies of an 831L without echo data, for which its file has no place.
    std::size_t left_out() const { return left_out_; }

  private:
    void take(const wire::Bytes& frame, double time) {
        const auto message = imagenex::parse(frame);
        if (!message) return;
        if (const auto* command = std::get_if<imagenex::SwitchCommand>(&*message)) writer_.command(*command);
        const auto* reply = std::get_if<imagenex::Reply>(&*message);
        if (reply != nullptr && !of_831l_ && writer_.has_place(*reply)) write(writer_.shot(*reply, time));
        const auto* of_pipe = std::get_if<imagenex::PipeReply>(&*message);
        if (of_pipe == nullptr || !of_831l_) return;
        if (of_pipe->data.empty())
            ++left_out_;
        else
            write(writer_.shot(*of_pipe, time));
    }

    void write(const wire::Bytes& shot) {
        out_.write(reinterpret_cast<const char*>(shot.data()), static_cast<std::streamsize>(shot.size()));
        ++shots_;
    }

    imagenex::ShotWriter writer_;
    bool of_831l_;
    std::ostream& out_;
    imagenex::Framer framers_[2];
    std::size_t shots_ = 0, left_out_ = 0;
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
    Progress progress("reading", input.size());
    for (Bytes bytes; !(bytes = input.read(std::size_t{64} << 10)).empty();) {
        line.add(false, time, bytes, false);
        progress.done(input.offset());
    }
    return line.shots();
}

std::size_t write_shots(Input& input, const std::string& line, ShotFormat format,
                        const std::filesystem::path& file) {
    std::ofstream out(file, std::ios::binary);
    Line shots(format, out);
    auto log = capture::open_if_log(input);
    std::size_t count = 0;
    if (log) {
        WatchedCapture watched(input, std::move(log));
        count = convert_capture(watched, line, shots);
    } else {
        count = convert_bytes(input, shots);
    }
    if (count == 0)
        throw StartError(Exit::data, scenario::in_quotes(input.name()) + ": no reply of an Imagenex " +
                                         (format == ShotFormat::shot_31l ? "831L with echo data" : "head"));
    if (shots.left_out() > 0)
        print_warning(counted(shots.left_out(), "message") +
                      " without echo data (profile points only) left out: a .31l file has no place for them");
    if (!out.flush()) throw std::runtime_error("cannot write all of it");
    return count;
}

/// Says what was written of a recording or a table.
std::string write_other(const Arguments& arguments, const std::filesystem::path& out,
                        const std::filesystem::path& file) {
    const convert::Source source{arguments.text("CAPTURE"), arguments.text("--line"),
                                 arguments.text("--message")};
    const auto formats = convert::formats_of(out);
    const bool is_bag = ending_of(out) == ".mcap";
    const auto written = !formats.empty() ? convert::write_recording(source, formats, file)
                         : is_bag         ? convert::write_bag(source, file)
                                          : convert::write_table(source, file);
    for (const auto& trouble : written.troubles) print_warning(trouble);
    if (written.lost > 0)
        print_warning(counted(written.lost, "message") + " of which parts are missing, not written");
    return counted(written.count, formats.empty() && !is_bag ? "row" : "message");
}

void require_known_kind(const std::filesystem::path& out) {
    if (shot_format_of(out) || !convert::formats_of(out).empty() || ending_of(out) == ".csv" ||
        ending_of(out) == ".mcap")
        return;
    throw StartError(Exit::usage, "OUT: " + scenario::in_quotes(out.string()) +
                                      " names no known kind of file; end it in .852, .81A, .31l, " +
                                      convert::endings() + ", .csv or .mcap");
}

int run_convert(const Arguments& arguments) {
    const std::filesystem::path out = arguments.text("OUT");
    require_known_kind(out);
    require_creatable(out);
    std::string done;
    std::optional<StartError> refused;  // its reason and status; write_whole knows those of files only
    try {
        write_whole(out, [&](const std::filesystem::path& file) {
            try {
                if (const auto format = shot_format_of(out)) {
                    Input input(arguments.text("CAPTURE"));
                    done = counted(write_shots(input, arguments.text("--line"), *format, file), "shot");
                } else {
                    done = write_other(arguments, out, file);
                }
            } catch (const StartError& error) {
                refused = error;
                throw;
            }
        });
    } catch (const StartError&) {
        if (refused) throw *refused;
        throw;
    }
    std::printf("%s\n", done.c_str());
    return 0;
}

}  // namespace

Verb convert_verb() {
    using Kind = Argument::Kind;
    return {"convert",
            "convert a capture to the sonar maker's own file format",
            {{Kind::positional,
              "CAPTURE",
              "",
              "pcap, pcapng, a maker's recording, a serial log as text, or raw bytes",
              {},
              true},
             {Kind::positional,
              "OUT",
              "",
              "file to write: .852, .81A or .31l (Imagenex), .kmall, .s7k, .jsf (EdgeTech), .xtf (EdgeTech, "
              "Imagenex 872), .svlog (Cerulean), .bin (Ping Viewer), .aris, .csv, .mcap (bag for ROS 2 and "
              "Foxglove)",
              {},
              true},
             {Kind::value, "--line", "NAME",
              "the line to convert, if the capture holds several: its name, an address or a port number"},
             {Kind::value, "--message", "NAME", "of .csv: only this kind of message, e.g. DeviceData"}},
            "  echoloop run config/imagenex-852.yaml --record dive.pcapng\n"
            "  echoloop convert dive.pcapng dive.852\n"
            "  echoloop convert survey.pcap survey.kmall\n"
            "  echoloop convert dive.pcapng dive.mcap\n"
            "  echoloop convert dive.pcapng angles.csv --message DeviceData",
            run_convert};
}

}  // namespace echoloop::cli
