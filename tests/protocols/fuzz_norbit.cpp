// libFuzzer: a byte stream in pieces whose sizes the input chooses, read as packets and as commands. What
// comes out is written back unchanged, all bytes are accounted for, and an image lies within its packet.
#include <algorithm>
#include <cstdlib>

#include "protocols/norbit/codec.h"
#include "protocols/norbit/command.h"
#include "protocols/norbit/framer.h"
#include "protocols/norbit/inspect.h"
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
    const std::size_t piece = data[0] + 1U;
    std::uint64_t framed = 0;
    const auto drain = [&] {
        while (const auto frame = framer.next()) {
            framed += 24 + frame->payload.size();
            check(*frame);
        }
        while (const auto line = lines.next()) check(*line);
    };
    for (std::size_t at = 1; at < size; at += piece) {
        const echoloop::wire::ByteView bytes(data + at, std::min(piece, size - at));
        framer.feed(bytes);
        lines.feed(bytes);
        drain();
    }
    check(lines.rest());
    framer.finish();
    drain();
    if (framed + framer.skipped_bytes() != size - 1 || framer.pending_bytes() != 0) std::abort();
    decode({data, size});
    recognise({data, size});
    return 0;
}
