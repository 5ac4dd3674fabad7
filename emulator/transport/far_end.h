// How a driver has set up its end of a pseudo-terminal. Asks the kernel; sets nothing but the mark by which
// it knows that nobody has set anything yet.
#pragma once

#include "emulator/transport/uart.h"

namespace echoloop {

/// Marks a slave as one whose rate no driver has set: 300 bit/s, which no sonar speaks and which programs
/// that keep the rate they find (gpsd) know. The setting outlives its driver, as that of a serial port does
/// (stty, and then a program that sets nothing).
void mark_unset(int slave);

/// What the driver's UART would be, were it one: rate 0 while it has set none. The kernel makes every
/// pseudo-terminal 8 bits without parity; stop bits beyond the first are time and no more.
/// `line`: either side of it.
uart::Receiver far_end(int line);

}  // namespace echoloop
