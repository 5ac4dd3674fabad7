// What a UART makes of bytes that were sent at another rate than its own. Bits and ratios only: no line, no
// time of day.
#pragma once

#include "emulator/contract/device.h"

namespace echoloop::uart {

/// Bits of a byte on the line, 8N1: a start bit, eight of data with the lowest first, a stop bit.
inline constexpr double bits_per_byte = 10;

/// What the receiver hands over where the stop bit was missing.
enum class BadByte { as_sampled, zero, nothing };

/// A receiving end, as its owner has set it up.
struct Receiver {
    double rate = 0;                              ///< bit/s; 0: not known
    BadByte framing_error = BadByte::as_sampled;  ///< of a byte without a stop bit
    BadByte line_break = BadByte::zero;           ///< of zeros all through and no stop bit
};

/// Whether two ends understand each other without loss: clocks within 3 % (the tenth bit of a byte is then a
/// third of a bit off at most).
bool agree(double one_rate, double other_rate);

/// What `receiver` hands over of `sent`, sent back to back at `sent_rate` bit/s between two silences. It
/// begins a byte at a falling edge, looks again half a bit later, samples each bit in its middle (an edge
/// there counts as over), and after a missing stop bit waits for the line to rest. At most five bytes for
/// each that was sent.
Bytes as_heard(ByteView sent, double sent_rate, const Receiver& receiver);

}  // namespace echoloop::uart
