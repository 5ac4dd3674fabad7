// libFuzzer: a byte stream in pieces whose sizes the input chooses, read as packets and as commands. What
// comes out is written back unchanged, all bytes are accounted for, and an image lies within its packet.
#include <algorithm>
#include <cstdlib>

#include "protocols/norbit/codec.h"
#include "protocols/norbit/command.h"
#include "protocols/norbit/framer.h"
#include "protocols/norbit/inspect.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

using namespace echoloop::norbit;

namespace {

void check(const Frame& frame) {
    const auto message = parse(frame);
    if (!message) return;
    const auto bytes = encode(*message, frame.header.version, frame.header.type);
    if (!std::equal(frame.payload.begin(), frame.payload.end(), bytes.begin() + 24, bytes.end()))
        std::abort();
    const auto* image = std::get_if<WaterColumn>(&*message);
    const auto found = image != nullptr ? image_of(*image) : std::nullopt;
    if (found && found->samples.size() + found->angles.size() > image->tail.size()) std::abort();
}

void check(const std::string& line) {
    if (line.size() > LineFramer::longest) std::abort();
    const auto command = read_command(line);
    if (!command) return;
    const std::string answer = write_answer(*command);
    if (read_command(std::string_view(answer).substr(0, answer.size() - 2)) != command) std::abort();
    for (const std::string& word : command->arguments) read_number(word);
}

}  // namespace

ECHOLOOP_MUTATOR({.family = "norbit", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    Framer framer;
    LineFramer lines;
    const echoloop::wire::ByteView stream(data + 1, size - 1);
    const auto take = [](const auto& frame) { check(frame); };
    echoloop::stream_in_pieces(framer, stream, data[0] + 1U, 24 + max_packet, take);
    for (std::size_t at = 0; at < stream.size(); at += data[0] + 1U) {
        lines.feed(stream.subspan(at, std::min(data[0] + std::size_t{1}, stream.size() - at)));
        while (const auto line = lines.next()) check(*line);
    }
    check(lines.rest());
    decode({data, size});
    recognise({data, size});
    return 0;
}
