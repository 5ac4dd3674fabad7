// libFuzzer: any bytes as what a sonar has said, and what the page and a bag make of them.
#include "protocols/inspect.h"
#include "tests/protocols/mutator.h"
#include "tools/bag/topics.h"
#include "tools/view/said_picture.h"

ECHOLOOP_MUTATOR({})

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop;
    const ByteView bytes(data, size);
    const inspect::Family* family = inspect::guess_family(bytes);
    if (family == nullptr) return 0;
    if (const auto maker = said::maker_of(family->name))
        for (const auto& message : family->decode(bytes)) {
            if (!message.reason.empty()) continue;
            const ByteView own = bytes.subspan(message.offset, message.size);
            for (auto picture = maker->take(message, own, true); picture; picture = maker->also())
                static_cast<void>(view::message_of(*picture, "sonar", 1, 0));
        }
    bag::Topics topics({.families = {{"sonar", std::string(family->name)}}},
                       [](const bag::Topics::Offer&, const bag::Topics::Make& make) { make(); });
    topics.bytes({.device = "sonar", .port = "line", .sent = true, .unix_time = 1e9, .bytes = bytes});
    topics.finish();
    return 0;
}
