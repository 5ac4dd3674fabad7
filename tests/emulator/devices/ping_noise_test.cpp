// Ping devices on a line that flips bytes: whatever was damaged before, the next good request is answered.
#include "tests/emulator/devices/noisy_line.h"

namespace echoloop::test {
namespace {

/// Asks for the protocol version, which comes at once.
NoisyHost host_that_says(std::vector<std::string> words) {
    const std::string request = "42520200060000000500a100";
    words.push_back(request);
    words.push_back("42520000040000009800");  // device information, the older way
    return {std::move(words), request,
            [](const Send& send) { return send.bytes.size() == 14 && send.bytes[4] == 5; }};
}

TEST(Ping360OnANoisyLine, ServesItsHostAgainWithinOneRequest) {
    Bench bench(make_device("ping360"));
    expect_no_wedge(bench, host_that_says({"42520e00290a00000000c8000b005800ee02b0040100a503",  // transducer
                                           "42520000570b0000f600"}));                           // motor off
}

TEST(Ping360OnANoisyLine, StillPings) {
    Bench bench(make_device("ping360"));
    NoisyHost host = host_that_says({});
    host.request = "42520e00290a00000000c8000b005800ee02b0040100a503";  // at 200 gradians
    host.is_answer = [](const Send& send) { return send.bytes.size() == 1224 && send.bytes[10] == 200; };
    host.patience = std::chrono::seconds(4);  // a damaged motor_off is none, but the head may be idle
    expect_no_wedge(bench, host, 200);
}

TEST(Ping1dOnANoisyLine, ServesItsHostAgainWithinOneRequest) {
    Bench bench(make_device("ping1d"));
    expect_no_wedge(bench, host_that_says({"42520100eb030000008301",    // manual mode
                                           "42520200ec0300003200b701",  // ping interval
                                           "4252000014050000ad00"}));   // profile
}

}  // namespace
}  // namespace echoloop::test
