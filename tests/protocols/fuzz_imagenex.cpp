// libFuzzer: a byte stream in pieces whose sizes the input chooses. What comes out is written back unchanged,
// and all bytes are accounted for.
#include <algorithm>
#include <cstdlib>

#include "protocols/imagenex/framer.h"
#include "protocols/imagenex/inspect.h"
#include "protocols/imagenex/shot_writer.h"
#include "tests/protocols/fuzz_stream.h"
#include "tests/protocols/mutator.h"

ECHOLOOP_MUTATOR({.family = "imagenex", .before = 1})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop::imagenex;
    if (size == 0) return 0;
    const bool commands = data[0] % 2 == 1;
    Framer framer(commands ? Framer::Takes::commands : Framer::Takes::everything);
    ShotWriter writer(data[0] % 4 < 2 ? ShotFormat::shot_852 : ShotFormat::shot_81a);
    ShotWriter of_pipe(ShotFormat::shot_31l);
    const auto take = [&](const auto& frame) {
        if (commands && frame.size() != command_bytes) std::abort();
        if (const auto again = rewritten(frame); !again.empty() && again != frame) std::abort();
        const auto message = parse(frame);
        if (!message) return frame.size();
        if (const auto* c = std::get_if<SwitchCommand>(&*message)) writer.command(*c), of_pipe.command(*c);
        if (const auto* r = std::get_if<Reply>(&*message); r != nullptr && ShotWriter::has_place(*r))
            if (!parse_shot(writer.shot(*r, static_cast<double>(frame.size())))) std::abort();
        if (const auto* r = std::get_if<PipeReply>(&*message); r != nullptr && !r->data.empty())
            if (!parse_shot(of_pipe.shot(*r, static_cast<double>(frame.size())))) std::abort();
        return frame.size();
    };
    echoloop::stream_in_pieces(framer, {data + 1, size - 1}, data[0] / 2 + 1U,
                               commands ? command_bytes : size, take);
    if (const auto again = rewritten({data, size});
        !again.empty() && !std::equal(again.begin(), again.end(), data))
        std::abort();
    decode({data, size});
    return 0;
}
