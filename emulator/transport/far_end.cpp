#include "emulator/transport/far_end.h"

#include <asm/termbits.h>  // for rates that have no name; <termios.h> cannot be had beside it
#include <sys/ioctl.h>

namespace echoloop {
namespace {

constexpr speed_t unset_rate = 300;

/// Linux' rules for bytes without a stop bit, as the drivers of real ports follow them.
uart::BadByte fate_of_bad_bytes(tcflag_t input) {
    if ((input & INPCK) == 0) return uart::BadByte::as_sampled;
    return (input & IGNPAR) != 0 ? uart::BadByte::nothing : uart::BadByte::zero;
}

uart::BadByte fate_of_breaks(tcflag_t input) {
    return (input & (IGNBRK | BRKINT)) != 0 ? uart::BadByte::nothing : uart::BadByte::zero;
}

}  // namespace

void mark_unset(int slave) {
    termios2 settings{};
    if (::ioctl(slave, TCGETS2, &settings) != 0) return;
    settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | (CBAUD << IBSHIFT));
    settings.c_cflag |= B300;
    ::ioctl(slave, TCSETS2, &settings);
}

uart::Receiver far_end(int line) {
    termios2 settings{};
    if (::ioctl(line, TCGETS2, &settings) != 0 || settings.c_ospeed == unset_rate || settings.c_ospeed == 0)
        return {};
    return {static_cast<double>(settings.c_ospeed), fate_of_bad_bytes(settings.c_iflag),
            fate_of_breaks(settings.c_iflag)};
}

}  // namespace echoloop
