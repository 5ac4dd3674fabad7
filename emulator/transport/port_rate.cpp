#include "emulator/transport/port_rate.h"

#include <asm/termbits.h>  // for rates that have no name; <termios.h> cannot be had beside it
#include <linux/serial.h>  // TIOCSER_TEMT
#include <sys/ioctl.h>

#include <cmath>

namespace echoloop {

bool has_sent_all(int port) {
    int waiting = 0;
    if (::ioctl(port, TIOCOUTQ, &waiting) == 0 && waiting > 0) return false;
    unsigned state = 0;
    return ::ioctl(port, TIOCSERGETLSR, &state) != 0 || (state & TIOCSER_TEMT) != 0;
}

bool change_rate(int port, double rate) {
    termios2 settings{};
    if (::ioctl(port, TCGETS2, &settings) != 0) return false;
    settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | (CBAUD << IBSHIFT));
    settings.c_cflag |= BOTHER | (BOTHER << IBSHIFT);
    settings.c_ispeed = settings.c_ospeed = static_cast<speed_t>(std::lround(rate));
    return ::ioctl(port, TCSETSW2, &settings) == 0;
}

}  // namespace echoloop
