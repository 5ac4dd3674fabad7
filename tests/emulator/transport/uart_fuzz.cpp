// libFuzzer: any bytes between two UARTs of rates and manners that the first byte chooses. What is heard
// stays bounded, and is what was said where both agree.
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "emulator/transport/uart.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop;
    if (size == 0) return 0;
    constexpr double rates[] = {300, 4800, 9600, 57600, 115200, 116000, 921600, 4e6};
    const double sent = rates[data[0] & 7];
    const auto bad = static_cast<uart::BadByte>((data[0] >> 6) % 3);
    const uart::Receiver receiver{rates[data[0] >> 3 & 7], bad, bad};
    const ByteView said(data + 1, size - 1);
    const Bytes heard = uart::as_heard(said, sent, receiver);
    if (heard.size() > 5 * said.size()) std::abort();
    if (uart::agree(sent, receiver.rate) && !std::ranges::equal(heard, said)) std::abort();
    return 0;
}
