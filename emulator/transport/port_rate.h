// The rate of a real serial port that is open already, changed between two messages. Knows nothing of
// pseudo-terminals, whose rate belongs to their driver.
#pragma once

namespace echoloop {

/// False while the port's UART still has to send some of what it was given, as far as its driver tells.
bool has_sent_all(int port);

/// Sets the rate, bit/s, behind the last byte that was given to the port; waits for what `has_sent_all`
/// cannot know of, a FIFO at most. False with errno if the port cannot.
bool change_rate(int port, double rate);

}  // namespace echoloop
