/* Makes a pseudo-terminal pass for a UART: answers the modem-line requests that a pty refuses, takes some time to send
 * what it was given, and says to what rate it is changed behind that. A stand-in, since no serial hardware can be had in
 * a test; everything else of the port is the kernel's and libserialport's own. */
#define _GNU_SOURCE
#include <asm/termbits.h>
#include <dlfcn.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <sys/ioctl.h>

static int to_send; /* so often a question for it says that not all has left */

typedef int (*ioctl_function)(int, unsigned long, ...);

int ioctl(int fd, unsigned long request, ...) {
    va_list arguments;
    va_start(arguments, request);
    void* argument = va_arg(arguments, void*);
    va_end(arguments);
    ioctl_function next = (ioctl_function)dlsym(RTLD_NEXT, "ioctl");
    const int result = next(fd, request, argument);
    if (result == 0 && request == TIOCOUTQ && to_send > 0) *(int*)argument = to_send--;
    if (result == 0 && request == TCSETSW2) {
        fprintf(stderr, "uart: %u bit/s, %d left to send\n", ((struct termios2*)argument)->c_ospeed, to_send);
        to_send = 20;
    }
    if (result == 0 || (errno != ENOTTY && errno != EINVAL)) return result;
    switch (request) {
        case TIOCMGET:
            *(int*)argument = TIOCM_DTR | TIOCM_RTS;
            return 0;
        case TIOCMSET:
        case TIOCMBIS:
        case TIOCMBIC:
            return 0;
        default:
            return result;
    }
}
