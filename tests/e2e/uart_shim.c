/* Makes a pseudo-terminal pass for a UART: answers the modem-line requests that a pty refuses. A stand-in, since no
 * serial hardware can be had in a test; everything else of the port is the kernel's and libserialport's own. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdarg.h>
#include <sys/ioctl.h>

typedef int (*ioctl_function)(int, unsigned long, ...);

int ioctl(int fd, unsigned long request, ...) {
    va_list arguments;
    va_start(arguments, request);
    void* argument = va_arg(arguments, void*);
    va_end(arguments);
    ioctl_function next = (ioctl_function)dlsym(RTLD_NEXT, "ioctl");
    const int result = next(fd, request, argument);
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
